#include "model/closure/closure_drive.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "model/base/angle.hpp"
#include "model/base/invalid_input.hpp"
#include "model/hinge/hinge_turn.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;
using Entries = std::vector<Eigen::Triplet<double>>;

void append_row(Entries& entries, int row, int column, const Vector3d& gradient) {
  for (int c = 0; c < 3; ++c) entries.emplace_back(row, column + c, gradient[c]);
}

RelativeTurn relative_turn(const RestHinge& hinge, const State& state) {
  return {hinge, state[hinge.lower], state[hinge.upper]};
}

Vector3d turn_since(const Pose& from, const Pose& now) {
  const Eigen::AngleAxisd turn(now.R * from.R.transpose());
  return turn.angle() * turn.axis();
}

/// Returns the transposed inverse of the left Jacobian of the exponential map at `turn`, applied to v.
Vector3d rate_of_logarithm(const Vector3d& turn, const Vector3d& v) {
  const double angle = turn.norm();
  const double c =
      angle < 1e-4 ? 1.0 / 12 : 1 / (angle * angle) - (1 + std::cos(angle)) / (2 * angle * std::sin(angle));
  return v + 0.5 * turn.cross(v) + c * turn.cross(turn.cross(v));
}

double residual(const HingeTurn& drive, const Linkage& structure, const State& state) {
  return std::remainder(hinge_turn(structure, state, drive.hinge) - drive.angle, 2 * pi);
}

double residual(const BodyPush& drive, const Linkage& structure, const State& state) {
  const Pose& now = state[drive.body];
  const Vector3d shift = (now.p - drive.from.p) / structure.size.edge_mm;
  return drive.direction.omega.dot(turn_since(drive.from, now)) + drive.direction.v.dot(shift) - drive.amount;
}

void append_gradient(const HingeTurn& drive, const Linkage& structure, const State& state, int row,
                     Entries& entries) {
  const RestHinge& hinge = structure.hinges[drive.hinge];
  const Vector3d gradient = relative_turn(hinge, state).rate_in_space();
  append_row(entries, row, 6 * hinge.upper, gradient);
  append_row(entries, row, 6 * hinge.lower, -gradient);
}

void append_gradient(const BodyPush& drive, const Linkage&, const State& state, int row, Entries& entries) {
  const Vector3d turn = turn_since(drive.from, state[drive.body]);
  append_row(entries, row, 6 * drive.body, rate_of_logarithm(turn, drive.direction.omega));
  append_row(entries, row, 6 * drive.body + 3, drive.direction.v);
}

void check(const HingeTurn& drive, const Linkage& structure) {
  if (drive.hinge < 0 || drive.hinge >= static_cast<int>(structure.hinges.size()))
    throw InvalidInput("the driven hinge does not exist");
  if (!(std::abs(drive.angle) < pi))
    throw InvalidInput("a driven hinge turns by less than 180 deg to either side");
}

void check(const BodyPush& drive, const Linkage& structure) {
  if (drive.body < 0 || drive.body >= static_cast<int>(structure.bodies.size()))
    throw InvalidInput("the pushed body does not exist");
  const Twist& d = drive.direction;
  if (!(d.omega.squaredNorm() + d.v.squaredNorm() > 0) || !d.omega.allFinite() || !d.v.allFinite())
    throw InvalidInput("the direction of a push must be finite and not zero");
  if (!std::isfinite(drive.amount)) throw InvalidInput("the amount of a push must be finite");
}

}  // namespace

void validate(const ClosureDrive& drive, const Linkage& structure) {
  std::visit([&](const auto& d) { check(d, structure); }, drive);
}

double hinge_turn(const Linkage& structure, const State& state, int hinge) {
  return relative_turn(structure.hinges[hinge], state).angle();
}

double turn_distance(const Linkage& structure, const State& a, const State& b) {
  double largest = 0;
  for (int h = 0; h < static_cast<int>(structure.hinges.size()); ++h) {
    const double turn = hinge_turn(structure, a, h) - hinge_turn(structure, b, h);
    largest = std::max(largest, std::abs(std::remainder(turn, 2 * pi)));
  }
  return largest;
}

double drive_residual(const ClosureDrive& drive, const Linkage& structure, const State& state) {
  return std::visit([&](const auto& d) { return residual(d, structure, state); }, drive);
}

void append_drive_gradient(const ClosureDrive& drive, const Linkage& structure, const State& state, int row,
                           Entries& entries) {
  std::visit([&](const auto& d) { append_gradient(d, structure, state, row, entries); }, drive);
}

}  // namespace kinetix::model
