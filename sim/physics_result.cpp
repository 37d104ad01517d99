#include "sim/physics_result.hpp"

#include <fmt/format.h>
#include <cmath>

namespace kinetix::sim {

std::string to_string(PhysicsResult::Status status) {
  switch (status) {
    case PhysicsResult::Status::settled:
      return "settled";
    case PhysicsResult::Status::not_settled:
      return "not settled";
    case PhysicsResult::Status::hinge_gap_exceeded:
      return "hinge gap exceeded";
    case PhysicsResult::Status::drive_missed:
      return "drive missed";
    case PhysicsResult::Status::wrong_branch:
      return "wrong branch";
    case PhysicsResult::Status::blocked:
      return "blocked";
    case PhysicsResult::Status::blew_up:
      break;
  }
  return "blew up";
}

namespace {

using Status = PhysicsResult::Status;

/// Returns the sine of a turn about a direction, times the direction's length.
double turn_about(const Eigen::Vector3d& spin, const Eigen::Matrix3d& R) {
  return 0.5 * spin.dot(Eigen::Vector3d(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1)));
}

/// Returns the mean of sin(theta) over the bodies between the plates. It measures their turn in the plane,
/// with the sign reversed for sublattice B.
double mean_turn(const model::Linkage& structure, const model::LinkageDrive& drive,
                 const model::State& state) {
  double sum = 0;
  for (const int b : drive.held) {
    sum += structure.bodies[b].spin
               ? turn_about(*structure.bodies[b].spin, state[b].R)
               : structure.bodies[b].sense *
                     (drive.axis == model::Axis::y ? state[b].R(1, 0) : -state[b].R(0, 1));
  }
  return sum / static_cast<double>(drive.held.size());
}

/// Returns whether the sheet folded to the branch of the drive. A sheet that its turning springs keep
/// straight is on neither branch, and passes.
bool is_on_branch(const model::Linkage& structure, const model::LinkageDrive& drive,
                  const PhysicsOptions& options, const model::State& state) {
  const double min_turn = options.elastic ? -1e-6 : 0;
  if (!drive.has_plates() || drive.compression == 0) return true;
  return drive.branch * mean_turn(structure, drive, state) > min_turn;
}

bool has_finite_state(const PhysicsResult& r) {
  return std::isfinite(r.gaps.max) && std::isfinite(r.drive_gap) && is_finite(r.state);
}

double gap_limit(const PhysicsOptions& options) {
  return options.elastic ? options.stretch_limit : options.gap_limit;
}

Status status_of(const model::Linkage& structure, const PhysicsOptions& options, bool settled, bool on_branch,
                 const PhysicsResult& r) {
  if (r.status == Status::blew_up || !has_finite_state(r)) return Status::blew_up;
  const bool open = !(r.gaps.max <= gap_limit(options)), off = !(r.drive_gap <= options.gap_limit);
  if (r.contact.depth > overlap_limit(structure, options)) return Status::blocked;
  if ((open || off) && r.contact.touches()) return Status::blocked;
  if (open) return Status::hinge_gap_exceeded;
  if (off) return Status::drive_missed;
  if (!on_branch) return Status::wrong_branch;
  return settled ? Status::settled : Status::not_settled;
}

std::string open_hinge(const model::Linkage& s, const PhysicsResult& r) {
  return fmt::format("the hinge on wall {} is open by {:.3g} cell edges", s.wall_name(r.gaps.worst_hinge),
                     r.gaps.max);
}

/// Describes the hinges of parts that still move. Rigid hinges hold during any motion.
std::string describe_moving_hinges(const model::Linkage& s, const PhysicsOptions& o, const PhysicsResult& r) {
  return o.elastic
             ? open_hinge(s, r)
             : fmt::format("parts still move, with hinges open by at most {:.2g} cell edges", r.gaps.max);
}

std::string contact(const model::Linkage& s, const PhysicsResult& r) {
  return fmt::format("the parts on vertices {} and {} touch (overlap {:.2g} cell edges)",
                     s.vertex_name(r.contact.first), s.vertex_name(r.contact.second), r.contact.depth);
}

std::string reason(const model::Linkage& s, const PhysicsOptions& o, const PhysicsResult& r) {
  switch (r.status) {
    case Status::settled:
      return fmt::format("settled after {:.3g} s: largest joint separation {:.2g} cell edges", r.simulated_s,
                         r.gaps.max);
    case Status::not_settled:
      return fmt::format("not at rest after {:.3g} s: {}{}", r.simulated_s, describe_moving_hinges(s, o, r),
                         r.contact.touches() ? ", " + contact(s, r) : "");
    case Status::hinge_gap_exceeded:
      return fmt::format("{}; at most {:.2g} is allowed (after {:.3g} s)", open_hinge(s, r), gap_limit(o),
                         r.simulated_s);
    case Status::drive_missed:
      return fmt::format("the drive is off by {:.3g} (cell edges or rad); at most {:.2g} is allowed",
                         r.drive_gap, o.gap_limit);
    case Status::wrong_branch:
      return "the sheet folded to the opposite side of that of the drive";
    case Status::blocked:
      return fmt::format("{}: {}, and the drive is off by {:.2g} (after {:.3g} s)", contact(s, r),
                         open_hinge(s, r), r.drive_gap, r.simulated_s);
    case Status::blew_up:
      break;
  }
  if (!has_finite_state(r))
    return fmt::format(
        "blew up after {:.3g} s: positions are no longer finite, so there is no state to compare",
        r.simulated_s);
  return fmt::format("blew up after {:.3g} s: a part became faster than {:.3g} cell edges/s or rad/s",
                     r.simulated_s, o.speed_limit);
}

}  // namespace

double overlap_limit(const model::Linkage& structure, const PhysicsOptions& options) {
  return options.elastic ? structure.size.thickness_mm / structure.size.edge_mm / 2 : options.overlap_limit;
}

void set_status(const model::Linkage& structure, const model::LinkageDrive& drive,
                const PhysicsOptions& options, bool settled, PhysicsResult& result) {
  const bool on_branch = is_on_branch(structure, drive, options, result.state);
  result.status = status_of(structure, options, settled, on_branch, result);
  result.why = reason(structure, options, result);
}

}  // namespace kinetix::sim
