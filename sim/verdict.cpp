#include "sim/verdict.hpp"

#include <fmt/format.h>

namespace kinetix {
namespace {

using Status = PhysicsResult::Status;

/// Mean of sin(theta) over the bodies between the plates: how far they turned in the plane, class B counted
/// backwards.
double mean_turn(const Structure& structure, const Drive& drive, const State& state) {
  double sum = 0;
  int count = 0;
  for (std::size_t b = 0; b < state.size(); ++b) {
    if (drive.grip && !drive.grip->contains(structure.bodies[b])) continue;
    const double turn = drive.axis == Axis::y ? state[b].R(1, 0) : -state[b].R(0, 1);
    sum += structure.bodies[b].sense() * turn;
    ++count;
  }
  return sum / count;
}

/// A sheet that its turning springs keep straight is on neither branch.
bool is_on_branch(const Structure& structure, const Drive& drive, const PhysicsOptions& options,
                  const State& state) {
  const double least_turn = options.elastic ? -1e-6 : 0;
  if (drive.kind == Drive::Kind::hinge || drive.compression == 0) return true;
  return drive.branch * mean_turn(structure, drive, state) > least_turn;
}

double gap_limit(const PhysicsOptions& options) {
  return options.elastic ? options.stretch_limit : options.gap_limit;
}

Status status_of(const Structure& structure, const PhysicsOptions& options, bool settled, bool on_branch,
                 const PhysicsResult& r) {
  if (r.status == Status::blew_up) return Status::blew_up;
  const bool open = !(r.gaps.max <= gap_limit(options)), off = !(r.drive_gap <= options.gap_limit);
  if (r.contact.depth > overlap_limit(structure, options)) return Status::blocked;
  if ((open || off) && r.contact.touches()) return Status::blocked;
  if (open) return Status::hinge_gap_exceeded;
  if (off) return Status::drive_missed;
  if (!on_branch) return Status::wrong_branch;
  return settled ? Status::settled : Status::not_settled;
}

std::string open_hinge(const Structure& s, const PhysicsResult& r) {
  return fmt::format("the hinge on wall {} is open by {:.3g} cell edges",
                     to_string(s.hinges[r.gaps.worst_hinge].wall), r.gaps.max);
}

std::string contact(const Structure& s, const PhysicsResult& r) {
  return fmt::format("the parts on vertices {} and {} touch (overlap {:.2g} cell edges)",
                     to_string(s.bodies[r.contact.first]), to_string(s.bodies[r.contact.second]),
                     r.contact.depth);
}

std::string reason(const Structure& s, const PhysicsOptions& o, const PhysicsResult& r) {
  switch (r.status) {
    case Status::settled:
      return fmt::format("settled after {:.3g} s: largest hinge gap {:.2g} cell edges", r.simulated_s,
                         r.gaps.max);
    case Status::not_settled:
      return fmt::format("not at rest after {:.3g} s: {}{}", r.simulated_s, open_hinge(s, r),
                         r.contact.touches() ? ", " + contact(s, r) : "");
    case Status::hinge_gap_exceeded:
      return fmt::format("{}, allowed are {:.2g} (after {:.3g} s)", open_hinge(s, r), gap_limit(o),
                         r.simulated_s);
    case Status::drive_missed:
      return fmt::format("the drive is off by {:.3g} (cell edges or rad), allowed are {:.2g}", r.drive_gap,
                         o.gap_limit);
    case Status::wrong_branch:
      return "the sheet folded to the other sign of theta than the drive asked for";
    case Status::blocked:
      return fmt::format("{}: {}, and the drive is off by {:.2g} (after {:.3g} s)", contact(s, r),
                         open_hinge(s, r), r.drive_gap, r.simulated_s);
    case Status::blew_up:
      break;
  }
  return fmt::format("blew up after {:.3g} s: a part became faster than {:.3g} cell edges/s or rad/s",
                     r.simulated_s, o.speed_limit);
}

}  // namespace

double overlap_limit(const Structure& structure, const PhysicsOptions& options) {
  return options.elastic ? structure.size.thickness_mm / structure.size.edge_mm / 2 : options.overlap_limit;
}

void judge(const Structure& structure, const Drive& drive, const PhysicsOptions& options, bool settled,
           PhysicsResult& result) {
  const bool on_branch = is_on_branch(structure, drive, options, result.state);
  result.status = status_of(structure, options, settled, on_branch, result);
  result.why = reason(structure, options, result);
}

}  // namespace kinetix
