#include "model/elastic/path/closed_form.hpp"

#include "model/base/invalid_input.hpp"
#include "model/closure/closure.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/closure/mobility.hpp"

namespace kinetix::model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d centre(const State& state, const std::vector<int>& bodies) {
  Vector3d sum = Vector3d::Zero();
  for (const int body : bodies) sum += state[body].p;
  return sum / static_cast<double>(bodies.size());
}

void move_all(State& state, const Matrix3d& rotation, const Vector3d& translation) {
  for (Pose& pose : state) {
    pose.R = rotation * pose.R;
    pose.p = rotation * pose.p + translation;
  }
}

/// Returns the rotation that aligns the plates' normal with their axis, and then turns the pin's up direction
/// as close to vertical as possible.
Matrix3d upright(const Vector3d& normal, const Vector3d& axis, const Pose& pin) {
  const Matrix3d rotation = rotation_between(normal, axis);
  const Vector3d up = rotation * pin.R.col(2), across = axis.cross(Vector3d::UnitZ());
  return Eigen::AngleAxisd(std::atan2(up.dot(across), up.z()), across.cross(Vector3d::UnitZ())) * rotation;
}

}  // namespace

std::optional<State> ClosedForm::at(double theta) const {
  if (!exact_) return {};
  const auto folded = folded_theta(system_.drive(), theta, system_.structure(), exact_.at);
  if (!folded) return {};
  State state = exact_.at(*folded);
  const State rest = rest_state(system_.structure());
  if (system_.holds_coordinate()) {
    hold_by_body(state, rest);
    return state;
  }
  hold_by_plates(state, rest);
  system_.place(theta, state);
  return state;
}

void ClosedForm::hold_by_body(State& state, const State& rest) const {
  const int held = system_.drive().held_body(system_.structure());
  const Matrix3d rotation = rest[held].R * state[held].R.transpose();
  move_all(state, rotation, rest[held].p - rotation * state[held].p);
}

void ClosedForm::hold_by_plates(State& state, const State& rest) const {
  const GrippedRows& rows = system_.gripped();
  const Vector3d axis = edge_direction(system_.drive().axis);
  const int pin = rows[0][rows[0].size() / 2];
  move_all(state, upright(planes_of(rows, state).normal, axis, state[pin]), Vector3d::Zero());
  Vector3d translation = rest[pin].p - state[pin].p;
  const double middle = (centre(rest, rows[0]) + centre(rest, rows[1])).dot(axis) / 2;
  translation +=
      (middle - (centre(state, rows[0]) + centre(state, rows[1])).dot(axis) / 2 - translation.dot(axis)) *
      axis;
  move_all(state, Matrix3d::Identity(), translation);
}

std::optional<double> ClosedForm::distance(const State& state, double theta) const {
  const auto exact = at(theta);
  if (!exact) return {};
  return turn_distance(system_.structure(), state, *exact);
}

bool ClosedForm::is_near(const State& state, double theta) const {
  const auto off = distance(state, theta);
  return off && *off <= near;
}

bool ClosedForm::is_far(const State& state, double theta) const {
  const auto off = distance(state, theta);
  return off && !(*off <= far);
}

bool ClosedForm::is_mirrored(const State& state, double theta) const {
  if (system_.driven_hinge() >= 0 || system_.drive().grips_part) return false;
  const auto from_mirror = distance(state, -theta);
  if (!from_mirror || !(*from_mirror <= near)) return false;
  const auto from_exact_state = distance(state, theta);
  return !from_exact_state || *from_mirror < *from_exact_state;
}

namespace {

// Ratio to the smallest singular value of flat. Stiffness scales with its square, so a sixteenth is left.
constexpr double nearly_lost = 0.25;

std::string rounded(double number) { return number_text(std::round(10 * number) / 10); }

std::string describe_energies(const ElasticSystem& system, const State& state, const State& exact) {
  const double spared = 1 - system.elastic_energy(state) / system.elastic_energy(exact);
  if (!(spared > 0)) return "";
  return ", with " + rounded(100 * spared) + " % less energy";
}

std::string cause(const Linkage& linkage, const State& exact) {
  const NullSpace flat = null_space(linkage, rest_state(linkage));
  if (flat.dofs() > 1) return "it is one of several motions that begin in the flat state";
  const NullSpace folded = null_space(linkage, exact);
  if (folded.dofs() > 1 || folded.smallest_other < nearly_lost * flat.smallest_other)
    return "a second motion begins near there, and its hinges turn for less";
  return "the hinges are too soft to hold it";
}

}  // namespace

std::optional<double> BranchingDetector::see(const State& state, double theta, bool followed_closed_form) {
  if (followed_closed_form) place_ = Place::on_it;
  if (place_ == Place::elsewhere) return {};
  const auto exact = closed_form_.at(theta);
  if (!exact) return {};
  const double off = turn_distance(system_.structure(), state, *exact);
  if (place_ == Place::left && off <= ClosedForm::near) place_ = Place::on_it;
  if (place_ == Place::on_it && system_.touching(*exact) > 0) place_ = Place::elsewhere;
  if (place_ != Place::on_it || !(off > ClosedForm::far)) return {};
  place_ = Place::left;
  return off;
}

std::string describe_branching(const ElasticSystem& system, const ClosedForm& closed_form, const State& state,
                               double theta, double turn) {
  const State exact = *closed_form.at(theta);
  return "left the analytic motion: hinges turn by up to " + rounded(to_degrees(turn)) + " deg otherwise" +
         describe_energies(system, state, exact) + "; " + cause(system.structure(), exact);
}

}  // namespace kinetix::model
