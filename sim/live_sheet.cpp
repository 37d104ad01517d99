#include "sim/live_sheet.hpp"

#include <cmath>
#include <limits>

#include "model/closure/closure.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/hinge/hinge_energy.hpp"
#include "sim/joints/external_pulls.hpp"
#include "sim/rigid_parts.hpp"
#include "sim/world.hpp"

namespace kinetix::sim {
namespace {

using Eigen::Vector3d;

constexpr double drag_stiffness =
    300;                       // part mass / s^2, per part of the sheet: it follows within a tenth of a
                               // second
constexpr double damping = 4;  // 1/s, of all speeds: a released sheet stops after a second
constexpr double pulled_damping =
    60;  // 1/s, with a tendon, which does not hold the sheet back: it moves no further than pulled
constexpr double drive_speed = 1;    // rad of theta per second: a fold takes about one
constexpr double max_motion = 0.1;   // cell edges or rad per step: linearisation is inaccurate beyond
constexpr double min_motion = 1e-6;  // cell edges or rad per step: a sheet that cannot move this far without
                                     // gaining energy is at rest
constexpr double fall = 10;    // cell edges / s^2: weight shows within a second and does not tear hinges
constexpr double newton = 30;  // part mass edge / s^2: a push of 1 N with rigid hinges
constexpr double flat_theta = 0.01;       // rad: below, a pressing hand has no lever arm
constexpr double flat_push = 0.5;         // rad / s^2 that then turns the parts to the side of positive theta
constexpr double resting_speed = 1e-4;    // cell edges/s or rad/s: not visible
constexpr double widest_gap = 0.5;        // cell edges, of a hinge: beyond, the sheet would have come apart
constexpr double point_stiffness = 1000;  // of a hinge point, part masses / step^2 (PhysicsOptions::elastic)

Vector3d in_rest_frame(const model::Linkage& structure, int body, const Vector3d& at) {
  return (at - structure.rest_position(body)) / structure.size.edge_mm;
}

}  // namespace

LiveSheet::LiveSheet(const model::Linkage& structure, const PhysicsOptions& options, double k_point_N_mm,
                     std::shared_ptr<const ContactParts> parts)
    : structure_(structure),
      options_(options),
      k_point_(k_point_N_mm),
      parts_(std::move(parts)),
      step_limit_(max_motion),
      state_(rest_state(structure)) {
  rebuild();
}

LiveSheet::~LiveSheet() = default;

void LiveSheet::rebuild() {
  std::vector<FixedBody> fixed_bodies;
  if (world_) fixed_bodies = world_->external_pulls().fixed_bodies;
  world_ = std::make_unique<World>(structure_, drive_, options_, parts_.get());
  world_->parts().place(state_);
  for (FixedBody& fixed_body : fixed_bodies) fixed_body.place = state_[fixed_body.body];
  world_->external_pulls().fixed_bodies = std::move(fixed_bodies);
  if (drive_) world_->set_drive(theta_);
  world_->limit_motion(step_limit_);
}

void LiveSheet::place(const model::State& state) {
  state_ = state;
  push_.reset();
  drive_.reset();
  rebuild();
}

void LiveSheet::drag(int body, const Vector3d& at, const Vector3d& to) {
  if (drive_) release();
  const double parts = static_cast<double>(structure_.bodies.size());
  world_->external_pulls().spring_pulls = {
      {body, in_rest_frame(structure_, body, at), to / structure_.size.edge_mm, drag_stiffness * parts}};
}

void LiveSheet::push(int body, const Vector3d& at, const Vector3d& force_N) {
  if (drive_) release();
  push_ = Push{body, in_rest_frame(structure_, body, at), force_N / force_unit()};
}

void LiveSheet::release() {
  world_->external_pulls().spring_pulls.clear();
  push_.reset();
  if (!drive_) return;
  drive_.reset();
  rebuild();
}

void LiveSheet::fix(int body, bool fixed) {
  std::vector<FixedBody>& fixed_bodies = world_->external_pulls().fixed_bodies;
  std::erase_if(fixed_bodies, [body](const FixedBody& fixed_body) { return fixed_body.body == body; });
  if (fixed) fixed_bodies.push_back({body, state_[body]});
}

bool LiveSheet::is_dragged() const { return !world_->external_pulls().spring_pulls.empty(); }

void LiveSheet::drive_to(const model::LinkageDrive& drive, const model::State& reference) {
  push_.reset();
  theta_ = theta_in(drive, structure_, state_);
  drive_ = drive;
  if (drive.has_plates()) stand_between_plates(reference);
  rebuild();
}

/// Moves the sheet between the plates, which close in on the middle of the flat sheet and hold a body of each
/// row at its height.
void LiveSheet::stand_between_plates(const model::State& reference) {
  state_ = aligned(state_, reference);
  const int along = drive_->axis == model::Axis::x ? 0 : 1;
  Vector3d shift = Vector3d::Zero();
  for (const std::vector<int>& row : drive_->gripped) {
    const int middle = row[row.size() / 2];
    shift[along] += 0.5 * (structure_.rest_position(middle) - state_[middle].p)[along];
    shift.z() -= 0.5 * state_[middle].p.z();
  }
  for (model::Pose& pose : state_) pose.p += shift;
}

void LiveSheet::step() {
  const double before = energy();
  if (drive_) advance_drive();
  apply_forces();
  leave_flat();
  world_->step();
  const bool pulled = drive_ && drive_->only_pulls();
  world_->parts().damp(std::exp(-(pulled ? pulled_damping : damping) * options_.step_s));
  accept(before);
  seconds_ += options_.step_s;
}

void LiveSheet::advance_drive() {
  const double change = drive_speed * options_.step_s;
  theta_ += std::clamp(drive_->theta() - theta_, -change, change);
  world_->set_drive(theta_);
}

void LiveSheet::apply_forces() {
  std::vector<model::Twist> kicks(state_.size());
  if (gravity_)
    for (model::Twist& kick : kicks) kick.v.z() -= fall;
  if (push_) {
    const Eigen::Matrix3d& R = state_[push_->body].R;
    const Vector3d force = R * push_->force;
    kicks[push_->body].v += force / RigidParts::mass;
    kicks[push_->body].omega += (R * push_->arm).cross(force) / (RigidParts::mass * options_.part_inertia);
  }
  if (gravity_ || push_) world_->parts().start(kicks, options_.step_s);
}

/// Pushes parts off the flat state. It is a dead point, since forces in its plane have no lever arm.
void LiveSheet::leave_flat() {
  if (!is_pulled()) return;
  const double theta = mean_theta(structure_, state_), goal = drive_ ? drive_->theta() : 1;
  if (std::abs(theta) < flat_theta && goal != 0)
    world_->parts().push((theta < 0 || goal < 0 ? -1 : 1) * flat_push * options_.step_s);
}

bool LiveSheet::holds(const model::State& next) const {
  return hinge_gaps(structure_, next).max <= widest_gap;
}

/// Accepts the new state. Keeps the old one and shortens the next step if hinges would have broken, numbers
/// overflowed, or energy grew without a source.
void LiveSheet::accept(double before) {
  model::State next = world_->parts().state();
  const bool grows = !is_pulled() && !(potential_energy(next) <= before);
  if (grows || !holds(next)) {
    world_->parts().place(state_);
    step_limit_ = std::max(step_limit_ / 4, min_motion);
  } else {
    state_ = std::move(next);
    step_limit_ = std::min(2 * step_limit_, max_motion);
    if (!is_pulled()) limit_energy(before);
  }
  world_->limit_motion(step_limit_);
}

void LiveSheet::limit_energy(double before) {
  const double kinetic = world_->parts().kinetic_energy(), excess = energy() - before;
  if (!(excess > 0)) return;
  world_->parts().damp(kinetic > excess ? std::sqrt((kinetic - excess) / kinetic) : 0);
}

/// Returns the force of 1 part mass edge / s^2 in N.
double LiveSheet::force_unit() const {
  if (!options_.elastic) return 1 / newton;
  const double k = point_stiffness / (options_.step_s * options_.step_s);
  return k_point_ * structure_.size.edge_mm / k;
}

bool LiveSheet::is_at_rest() const { return !is_pulled() && world_->parts().fastest() < resting_speed; }

double LiveSheet::pull_force_N() const {
  if (!is_dragged() || !options_.elastic) return std::numeric_limits<double>::quiet_NaN();
  return force_unit() * world_->external_pulls().pull(state_).norm();
}

double LiveSheet::potential(const model::State& state) const {
  if (!options_.elastic) return 0;
  double sum = 0;
  for (std::size_t h = 0; h < structure_.hinges.size(); ++h) {
    const model::RestHinge& hinge = structure_.hinges[h];
    sum += model::hinge_energy(hinge, options_.elastic->of(h), state[hinge.lower], state[hinge.upper],
                               structure_.size.edge_mm)
               .total();
  }
  return sum;
}

double LiveSheet::hinge_energy_Nmm() const {
  if (!options_.elastic) return std::numeric_limits<double>::quiet_NaN();
  return potential(state_) * k_point_ * structure_.size.edge_mm * structure_.size.edge_mm;
}

double LiveSheet::potential_energy(const model::State& state) const {
  const double k = point_stiffness / (options_.step_s * options_.step_s);
  double weight = 0;
  if (gravity_)
    for (const model::Pose& pose : state) weight += fall * RigidParts::mass * pose.p.z();
  return k * potential(state) + weight / structure_.size.edge_mm;
}

double LiveSheet::energy() const { return world_->parts().kinetic_energy() + potential_energy(state_); }

}  // namespace kinetix::sim
