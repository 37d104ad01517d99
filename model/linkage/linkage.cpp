#include "model/linkage/linkage.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "model/base/invalid_input.hpp"

namespace kinetix::model {

void check_lengths(const CellSize& size) {
  for (const auto& [name, value] :
       {std::pair("cell edge", size.edge_mm), std::pair("wall thickness", size.thickness_mm),
        std::pair("wall height", size.height_mm)})
    if (!(value > 0) || !std::isfinite(value))
      throw InvalidInput(std::string(name) + " must be a positive length in mm");
}

namespace {

using Eigen::Vector3d;

Vector3d across(const Vector3d& edge) { return Vector3d(-edge.y(), edge.x(), 0).normalized(); }

}  // namespace

Vector3d wall_up(const Vector3d& edge, double beta) {
  return std::cos(beta) * Vector3d::UnitZ() - std::sin(beta) * across(edge);
}

Vector3d hinge_axis(const Vector3d& edge, const HingeParameters& p) {
  return std::cos(p.alpha) * edge.normalized() + std::sin(p.alpha) * wall_up(edge, p.beta);
}

RestHinge rest_hinge(const HingedWall& wall) {
  const auto& [t, alpha, beta, offset] = wall.hinge;
  RestHinge out;
  out.lower = wall.lower;
  out.upper = wall.upper;
  out.edge = wall.edge;
  out.across = across(wall.edge);
  out.lower_arm = t * wall.edge + offset * out.across;
  out.upper_arm = (t - 1) * wall.edge + offset * out.across;
  out.axis = hinge_axis(wall.edge, wall.hinge);
  out.axis_alpha = std::cos(alpha) * wall_up(wall.edge, beta) - std::sin(alpha) * wall.edge.normalized();
  out.axis_beta = std::sin(alpha) * wall_up(wall.edge, beta + pi / 2);
  return out;
}

std::array<Plate, 2> plates(const HingedWall& wall, int index) {
  const auto& [t, alpha, beta, offset] = wall.hinge;
  const double length = wall.edge.norm();
  Plate lower;
  lower.body = wall.lower;
  lower.hinge = index;
  lower.edge = wall.edge.normalized();
  lower.up = wall_up(wall.edge, beta);
  lower.up_beta = wall_up(wall.edge, beta + pi / 2);
  lower.length = t * length;
  lower.length_t = length;
  lower.slant = std::cos(alpha) / std::sin(alpha);
  Plate upper = lower;
  upper.body = wall.upper;
  upper.edge = -lower.edge;
  upper.length = (1 - t) * length;
  upper.length_t = -length;
  upper.slant = -lower.slant;
  return {lower, upper};
}

namespace {

constexpr double vertical = 1e-9;  // rad from z: far above rounding, far below any tilt that is meant

}  // namespace

bool is_vertical(const Eigen::Vector3d& axis) { return axis.head<2>().norm() <= vertical; }

bool is_vertical(const RestHinge& hinge) { return !hinge.ball && is_vertical(hinge.axis); }

Eigen::Vector3d Linkage::rest_position(int body) const { return bodies[body].position * size.edge_mm; }

bool all_vertical(const Linkage& linkage) {
  return std::all_of(linkage.hinges.begin(), linkage.hinges.end(),
                     [](const RestHinge& hinge) { return is_vertical(hinge); });
}

}  // namespace kinetix::model
