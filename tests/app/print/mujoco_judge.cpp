#include "tests/app/print/mujoco_judge.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

namespace kinetix::testing {
namespace {

std::string& warnings() {
  static std::string text;
  return text;
}

void keep(const char* warning) { warnings() += std::string(warning) + "\n"; }

std::unique_ptr<mjModel, decltype(&mj_deleteModel)> loaded(const std::string& xml, std::string& error) {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "scene.xml", static_cast<int>(xml.size()));
  std::memcpy(files->filedata[0], xml.data(), xml.size());
  char text[1000] = "";
  std::unique_ptr<mjModel, decltype(&mj_deleteModel)> model(
      mj_loadXML("scene.xml", files.get(), text, sizeof text), &mj_deleteModel);
  mj_deleteVFS(files.get());
  error = text;
  return model;
}

}  // namespace

MujocoVerdict fold_in_mujoco(const std::string& xml, double fold_seconds, double settle_seconds) {
  MujocoVerdict verdict;
  mju_user_warning = keep;
  warnings().clear();
  const auto model = loaded(xml, verdict.error);
  if (!model) return verdict;
  verdict.mass_kg = mj_getTotalmass(model.get());
  verdict.joints = static_cast<int>(model->njnt);
  verdict.constraints = static_cast<int>(model->neq);
  const std::unique_ptr<mjData, decltype(&mj_deleteData)> data(mj_makeData(model.get()), &mj_deleteData);
  while (data->time < fold_seconds + settle_seconds && warnings().empty()) {
    const double share = std::min(1.0, data->time / fold_seconds);
    if (model->nu > 0) data->ctrl[0] = share * share * (3 - 2 * share);
    mj_step(model.get(), data.get());
  }
  verdict.error += warnings();
  for (int j = 0; j < model->njnt; ++j)
    verdict.energy_J += model->jnt_stiffness[j] * std::pow(data->qpos[model->jnt_qposadr[j]], 2) / 2;
  for (int b = 0;; ++b) {
    const int id = mj_name2id(model.get(), mjOBJ_BODY, ("b" + std::to_string(b)).c_str());
    if (id < 0) break;
    verdict.positions.push_back(Eigen::Map<const Eigen::Vector3d>(data->xpos + 3 * id));
  }
  return verdict;
}

}  // namespace kinetix::testing
