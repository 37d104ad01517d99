#include "benchmarks/peers/mujoco_run.hpp"

#include <mujoco/mujoco.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "benchmarks/peers/mujoco_scene.hpp"
#include "model/base/invalid_input.hpp"
#include "sim/physics_run.hpp"

namespace kinetix::bench {
namespace {

using Clock = std::chrono::steady_clock;
using Model = std::unique_ptr<mjModel, decltype(&mj_deleteModel)>;
using Data = std::unique_ptr<mjData, decltype(&mj_deleteData)>;
using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

void keep_quiet(const char*) {}

Model compile(const std::string& xml) {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "scene.xml", static_cast<int>(xml.size()));
  std::memcpy(files->filedata[0], xml.data(), xml.size());
  char error[1000] = "";
  Model model(mj_loadXML("scene.xml", files.get(), error, sizeof error), &mj_deleteModel);
  mj_deleteVFS(files.get());
  if (!model) throw std::runtime_error(std::string("MuJoCo refuses the scene: ") + error);
  return model;
}

int steps_in(double seconds, double step_s) { return static_cast<int>(std::ceil(seconds / step_s - 1e-9)); }

class Run {
 public:
  Run(const model::Structure& structure, const model::LinkageDrive& drive, const MujocoSettings& settings)
      : structure_(structure),
        drive_(drive),
        settings_(settings),
        driven_(drive.hinge),
        links_(mujoco_links(structure, driven_, settings.bodies)),
        model_(compile(mujoco_scene(structure, links_, driven_, settings))),
        data_(mj_makeData(model_.get()), &mj_deleteData),
        drive_steps_(std::max(1, steps_in(settings.drive_seconds, settings.step_s))),
        all_steps_(drive_steps_ + steps_in(settings.settle_seconds, settings.step_s)),
        damping_(std::exp(-settings.settle_damping * settings.step_s)) {
    for (int b = 0; b < bodies(); ++b) ids_.push_back(id(mjOBJ_BODY, 'b', b));
    start(sim::start_motion(structure), 2 * drive.theta() / (drive_steps_ * settings.step_s));
  }

  MujocoResult run() {
    const auto begin = Clock::now();
    bool settled = false;
    while (result_.steps < all_steps_ && !settled && !blew_up()) {
      step();
      settled = result_.steps > drive_steps_ && fastest_hinge() <= settings_.settle_speed;
    }
    result_.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    read_state();
    result_.status = blew_up() ? MujocoResult::Status::blew_up
                     : settled ? MujocoResult::Status::settled
                               : MujocoResult::Status::not_settled;
    return std::move(result_);
  }

 private:
  int bodies() const { return static_cast<int>(structure_.bodies.size()); }
  int id(mjtObj kind, char prefix, int index) const {
    return mj_name2id(model_.get(), kind, (prefix + std::to_string(index)).c_str());
  }
  int joint(int hinge) const { return id(mjOBJ_JOINT, 'j', hinge); }

  void start(const std::vector<model::Twist>& motion, double rate) {
    for (int b = 0; b < bodies(); ++b) {
      const MujocoLink& link = links_[b];
      if (link.parent < 0) {
        double* speed = data_->qvel + model_->body_dofadr[ids_[b]];
        Eigen::Map<Eigen::Vector3d>{speed} = rate * motion[b].v;
        Eigen::Map<Eigen::Vector3d>{speed + 3} = rate * motion[b].omega;
      } else {
        const model::Hinge& hinge = structure_.hinges[link.hinge];
        data_->qvel[model_->jnt_dofadr[joint(link.hinge)]] =
            rate *
            (motion[b].omega - motion[link.parent].omega).dot(hinge_axis(hinge.wall.axis, hinge.parameters));
      }
    }
  }

  void step() {
    const double tau = std::min(1.0, (result_.steps + 1.0) / drive_steps_);
    if (result_.steps >= drive_steps_) mju_scl(data_->qvel, data_->qvel, damping_, model_->nv);
    model_->eq_data[0] = drive_.angle * tau * (2 - tau);
    mj_step(model_.get(), data_.get());
    ++result_.steps;
  }

  /// Before the last step: MuJoCo has no later speeds of bodies.
  double fastest_hinge() const {
    double fastest = 0;
    for (const model::Hinge& hinge : structure_.hinges)
      fastest = std::max(fastest, (turning(hinge.upper) - turning(hinge.lower)).norm());
    return fastest;
  }
  Eigen::Map<const Eigen::Vector3d> turning(int body) const {
    return Eigen::Map<const Eigen::Vector3d>(data_->cvel + 6 * ids_[body]);
  }

  bool blew_up() const {
    return data_->warning[mjWARN_BADQPOS].number > 0 || data_->warning[mjWARN_BADQVEL].number > 0 ||
           data_->warning[mjWARN_BADQACC].number > 0;
  }

  void read_state() {
    mj_kinematics(model_.get(), data_.get());
    for (const int b : ids_)
      result_.state.push_back(
          {RowMajor3(Eigen::Map<const RowMajor3>(data_->xmat + 9 * b)),
           structure_.size.edge_mm * Eigen::Map<const Eigen::Vector3d>(data_->xpos + 3 * b)});
    result_.gaps = hinge_gaps(structure_, result_.state);
    result_.drive_gap = std::abs(data_->qpos[model_->jnt_qposadr[joint(driven_)]] - drive_.angle);
  }

  const model::Structure& structure_;
  const model::LinkageDrive& drive_;
  const MujocoSettings& settings_;
  const int driven_;
  const std::vector<MujocoLink> links_;
  Model model_;
  Data data_;
  const int drive_steps_, all_steps_;
  const double damping_;
  std::vector<int> ids_;  ///< MuJoCo's, by body
  MujocoResult result_;
};

}  // namespace

bool has_mujoco() { return true; }

MujocoResult run_mujoco(const model::Structure& structure, const model::LinkageDrive& drive,
                        const MujocoSettings& settings) {
  if (drive.hinge < 0) throw InvalidInput("the MuJoCo run is driven by a hinge");
  mju_user_warning = keep_quiet;
  return Run(structure, drive, settings).run();
}

}  // namespace kinetix::bench
