#include "sim/verdict.hpp"

#include <fmt/format.h>

namespace kinetix {
namespace {

using Status = PhysicsResult::Status;

Status status_of(const PhysicsOptions& options, bool settled, const PhysicsResult& r) {
  if (r.status == Status::blew_up) return Status::blew_up;
  const bool open = !(r.gaps.max <= options.gap_limit), off = !(r.drive_gap <= options.gap_limit);
  if (r.contact.depth > options.overlap_limit) return Status::blocked;
  if ((open || off) && r.contact.touches()) return Status::blocked;
  if (open) return Status::hinge_gap_exceeded;
  if (off) return Status::drive_missed;
  return settled ? Status::settled : Status::not_settled;
}

std::string name(Vertex v) { return fmt::format("[{}, {}]", v.i, v.j); }

std::string open_hinge(const Structure& s, const PhysicsResult& r) {
  const Wall& wall = s.hinges[r.gaps.worst_hinge].wall;
  return fmt::format("the hinge on wall [{}, {}] is open by {:.3g} cell edges", name(wall.from),
                     name(wall.to()), r.gaps.max);
}

std::string contact(const Structure& s, const PhysicsResult& r) {
  return fmt::format("the parts on vertices {} and {} touch (overlap {:.2g} cell edges)",
                     name(s.bodies[r.contact.first]), name(s.bodies[r.contact.second]), r.contact.depth);
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
      return fmt::format("{}, allowed are {:.2g} (after {:.3g} s)", open_hinge(s, r), o.gap_limit,
                         r.simulated_s);
    case Status::drive_missed:
      return fmt::format("the drive is off by {:.3g} (cell edges or rad), allowed are {:.2g}", r.drive_gap,
                         o.gap_limit);
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

void judge(const Structure& structure, const PhysicsOptions& options, bool settled, PhysicsResult& result) {
  result.status = status_of(options, settled, result);
  result.why = reason(structure, options, result);
}

}  // namespace kinetix
