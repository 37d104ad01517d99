#include "app/state_json.hpp"

#include <Eigen/Geometry>

namespace kinetix {
namespace {

using Json = nlohmann::ordered_json;

Json pose_json(const Pose& pose) {
  const Eigen::Quaterniond q(pose.R);
  return {{"position_mm", {pose.p.x(), pose.p.y(), pose.p.z()}},
          {"quaternion_wxyz", {q.w(), q.x(), q.y(), q.z()}}};
}

}  // namespace

Json poses_json(const State& state) {
  Json poses = Json::array();
  for (const Pose& pose : state) poses.push_back(pose_json(pose));
  return poses;
}

}  // namespace kinetix
