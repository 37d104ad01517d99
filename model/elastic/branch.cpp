#include "model/elastic/branch.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/elastic/lowest_mode.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double first_seed = 1e-3;    // rad, cell edges: a first step along the lowest mode
constexpr double slender_seed = 1e-5;  // the same where the valley bends away from its line sooner
constexpr double nearby = 0.05;        // rad, cell edges: a longer step of Newton's method is no relaxation
// Rad, cell edges: where neither seed is lower, Newton starts out there.
constexpr double curved_valley = 0.05;
constexpr double longest_step = 0.3;   // rad, cell edges: a seed doubles up to here while the energy falls
constexpr double checkerboard = 1e-3;  // share of all turns: less has no class, and `side` decides

Vector3d centre(const State& state, const std::vector<int>& bodies) {
  Vector3d sum = Vector3d::Zero();
  for (const int body : bodies) sum += state[body].p;
  return sum / static_cast<double>(bodies.size());
}

void move_all(State& state, const Eigen::Matrix3d& turn, const Vector3d& shift) {
  for (Pose& pose : state) {
    pose.R = turn * pose.R;
    pose.p = turn * pose.p + shift;
  }
}

/// The turn that takes the plates' normal to their axis and lifts the pin's upright as far as it then can.
Eigen::Matrix3d upright(const Vector3d& normal, const Vector3d& axis, const Pose& pin) {
  const Eigen::Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(normal, axis).toRotationMatrix();
  const Vector3d up = turn * pin.R.col(2), across = axis.cross(Vector3d::UnitZ());
  return Eigen::AngleAxisd(std::atan2(up.dot(across), up.z()), across.cross(Vector3d::UnitZ())) * turn;
}

}  // namespace

Branch::Branch(const ElasticSystem& system, const ExactMotion& exact, double goal, int side)
    : system_(system), exact_(exact), goal_(goal), side_(side) {}

Branch::Start Branch::leave(double theta, const State& from, TangentStiffness& tangent) const {
  if (const auto exact = exact_state(theta))
    if (system_.energy(*exact, theta) < system_.energy(from, theta))
      return onto_exact(theta, *exact, tangent);
  return along_lowest_mode(theta, from, tangent);
}

Branch::Start Branch::onto_exact(double theta, const State& exact, TangentStiffness& tangent) const {
  const State equilibrium = relaxed(theta, exact, tangent);
  system_.linearise(equilibrium, theta, tangent);
  if (tangent.factorise(0)) return {Way::exact, equilibrium};
  Start off = along_lowest_mode(theta, equilibrium, tangent, true);
  if (off.way != Way::lowest_mode || !(system_.energy(off.state, theta) < system_.energy(equilibrium, theta)))
    return {Way::exact, exact};
  off.way = Way::off_exact;
  return off;
}

// One step of Newton's method: it calls up the forces in the hinges, and with them what bends under these.
State Branch::relaxed(double theta, const State& exact, TangentStiffness& tangent) const {
  const VectorXd gradient = system_.dofs().restrict(system_.linearise(exact, theta, tangent));
  if (!tangent.factorise(0)) return exact;
  const VectorXd step = -system_.dofs().extend(tangent.solve(gradient));
  return system_.length(exact, step) <= nearby ? system_.retract(exact, step) : exact;
}

Branch::Start Branch::along_lowest_mode(double theta, const State& from, TangentStiffness& tangent,
                                        bool is_folded) const {
  const LowestMode soft = lowest_mode(tangent);
  if (!soft.converged) return {};
  if (!(soft.value < 0)) return {Way::none, from};
  const VectorXd all = system_.dofs().extend(soft.direction);
  const double side = is_folded ? option_side(all) : drive_side(all);
  return {Way::lowest_mode, downhill(theta, from, side / system_.length(from, all) * all)};
}

// Where the drive holds it: plates face each other, a driven hinge's lower body rests.
std::optional<State> Branch::exact_state(double theta) const {
  if (!exact_) return {};
  const Linkage& structure = system_.structure();
  State state = exact_.at(theta);
  const State rest = rest_state(structure);
  if (system_.driven_hinge() >= 0) {
    const int held = system_.hinges()[system_.driven_hinge()].lower;
    const Eigen::Matrix3d turn = rest[held].R * state[held].R.transpose();
    move_all(state, turn, rest[held].p - turn * state[held].p);
    return state;
  }
  const GrippedRows& rows = system_.gripped();
  const Vector3d axis = edge_direction(system_.drive().axis);
  const int pin = rows[0][rows[0].size() / 2];
  move_all(state, upright(planes_of(rows, state).normal, axis, state[pin]), Vector3d::Zero());
  Vector3d shift = rest[pin].p - state[pin].p;
  const double middle = (centre(rest, rows[0]) + centre(rest, rows[1])).dot(axis) / 2;
  shift +=
      (middle - (centre(state, rows[0]) + centre(state, rows[1])).dot(axis) / 2 - shift.dot(axis)) * axis;
  move_all(state, Eigen::Matrix3d::Identity(), shift);
  system_.place(theta, state);
  return state;
}

State Branch::downhill(double theta, const State& from, const VectorXd& along) const {
  const auto at = [&](double s) { return system_.retract(from, s * along); };
  const auto energy = [&](double s) { return system_.energy(at(s), theta); };
  const double least = system_.energy(from, theta);
  double s = energy(first_seed) < least ? first_seed : slender_seed;
  if (!(energy(s) < least)) return at(curved_valley);
  while (2 * s <= longest_step && energy(2 * s) < energy(s)) s *= 2;
  return at(s);
}

double Branch::drive_side(const VectorXd& all) const {
  const auto& bodies = system_.structure().bodies;
  double with = 0, size = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    with += bodies[b].sense * all[6 * b + 2];
    size += std::abs(all[6 * b + 2]);
  }
  if (std::abs(with) > checkerboard * size && size > 0) return std::copysign(1.0, with * goal_);
  return option_side(all);
}

double Branch::option_side(const VectorXd& all) const {
  Eigen::Index largest = 0;
  all.cwiseAbs().maxCoeff(&largest);
  return side_ * std::copysign(1.0, all[largest]);
}

}  // namespace kinetix::model
