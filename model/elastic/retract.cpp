#include "model/elastic/retract.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

// Rad: below, the next term of the series is less than 2e-15, and the formulas lose half their digits.
constexpr double small_angle = 1e-3;

/// Returns the integral of exp(s omega) v over s from 0 to 1.
Vector3d along_arc(const Vector3d& omega, const Vector3d& v) {
  const double squared = omega.squaredNorm(), angle = std::sqrt(squared);
  const double a = angle < small_angle ? 0.5 - squared / 24 : (1 - std::cos(angle)) / squared;
  const double b =
      angle < small_angle ? 1.0 / 6 - squared / 120 : (angle - std::sin(angle)) / (squared * angle);
  return v + a * omega.cross(v) + b * omega.cross(omega.cross(v));
}

}  // namespace

State retract(const Linkage& structure, const State& state, const Eigen::VectorXd& twists) {
  State out = state;
  for (std::size_t b = 0; b < state.size(); ++b) {
    const Vector3d omega = twists.segment<3>(6 * b), v = twists.segment<3>(6 * b + 3);
    const Eigen::AngleAxisd turn(omega.norm(), omega.stableNormalized());
    out[b].R = Eigen::Quaterniond(turn * state[b].R).normalized().toRotationMatrix();
    out[b].p += structure.size.edge_mm * along_arc(omega, v);
  }
  return out;
}

}  // namespace kinetix::model
