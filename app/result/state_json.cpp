#include "app/result/state_json.hpp"

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

Json pose_json(const model::Pose& pose) {
  const Eigen::Quaterniond q(pose.R);
  return {{"position_mm", {pose.p.x(), pose.p.y(), pose.p.z()}},
          {"quaternion_wxyz", {q.w(), q.x(), q.y(), q.z()}}};
}

}  // namespace

Json poses_json(const model::State& state) {
  Json poses = Json::array();
  for (const model::Pose& pose : state) poses.push_back(pose_json(pose));
  return poses;
}

Json points_json(const std::vector<Eigen::Vector2d>& points) {
  Json out = Json::array();
  for (const auto& p : points) out.push_back({p.x(), p.y()});
  return out;
}

nlohmann::ordered_json point_json(const Eigen::Vector3d& point) { return {point.x(), point.y(), point.z()}; }

}  // namespace kinetix::app
