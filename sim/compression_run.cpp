#include "sim/compression_run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "sim/world.hpp"

namespace kinetix {
namespace {
using Status = PhysicsResult::Status;
}

std::string to_string(Status status) {
  switch (status) {
    case Status::settled:
      return "settled";
    case Status::not_settled:
      return "not settled";
    case Status::hinge_gap_exceeded:
      return "hinge gap exceeded";
    case Status::blew_up:
      break;
  }
  return "blew up";
}

PhysicsResult run_compression(const Structure& structure, const Drive& drive, const PhysicsOptions& o,
                              const PhysicsObserver&) {
  o.validate();
  validate(drive, structure);
  const auto t0 = std::chrono::steady_clock::now();
  World world(structure, drive, o);
  const double theta = drive.theta();
  const int drive_steps = static_cast<int>(std::ceil(o.drive_seconds / o.step_s));
  const int settle_steps = static_cast<int>(std::ceil(o.settle_seconds / o.step_s));
  PhysicsResult r;
  // s(tau) = tau^2 (3 - 2 tau) + slope
  const double a = getenv("SLOPE") ? atof(getenv("SLOPE")) : 1.0;
  const auto s = [&](double x) { return a * x * (2 - x) + (1 - a) * x * x * (3 - 2 * x); };
  world.start(theta * 2 * a / o.drive_seconds);
  for (r.steps = 0; r.steps < drive_steps + settle_steps;) {
    const double tau = std::min(1.0, (r.steps + 1.0) / drive_steps);
    world.set_drive(theta * s(tau));
    {
      static double dd = getenv("DD") ? atof(getenv("DD")) : 0;
      world.damp(std::exp(-(r.steps >= drive_steps ? o.settle_damping : dd) * o.step_s));
    }
    world.step();
    ++r.steps;
    const double v = world.fastest_part();
    if (!(v < o.speed_limit)) {
      r.status = Status::blew_up;
      break;
    }
    if (getenv("TRACE") && r.steps % atoi(getenv("TRACE")) == 0) {
      auto g = hinge_gaps(structure, world.state());
      auto c = world.deepest_contact();
      printf("%d tau %.3f v %.3e gap %.3e rms %.3e axis %.3e contact %d %d %.2e\n", r.steps, tau, v, g.max,
             g.rms, g.axis_max, c.first, c.second, c.depth);
    }
    if (r.steps > drive_steps && v < o.settle_speed &&
        hinge_gaps(structure, world.state()).max < o.settle_gap) {
      r.status = Status::settled;
      break;
    }
  }
  r.state = world.state();
  r.gaps = hinge_gaps(structure, r.state);
  if (r.status != Status::blew_up && !(r.gaps.max <= o.gap_limit)) r.status = Status::hinge_gap_exceeded;
  r.simulated_s = r.steps * o.step_s;
  r.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count();
  return r;
}

}  // namespace kinetix
