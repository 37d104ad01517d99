#pragma once

#include <functional>
#include <string>

#include "model/state.hpp"
#include "sim/drive.hpp"
#include "sim/physics_options.hpp"

namespace kinetix {

/// Outcome of a physics run. Only a settled one is a result to trust.
struct PhysicsResult {
  enum class Status {
    settled,             ///< at rest, all hinges closed
    not_settled,         ///< still moving, or a hinge not yet closed to settle_gap, when the time was up
    hinge_gap_exceeded,  ///< a hinge stayed open by more than gap_limit
    blew_up,             ///< a speed became infinite, NaN or larger than speed_limit
  };

  Status status = Status::not_settled;
  std::string why;         ///< the status in words, with its numbers
  State state;             ///< last state, mm, in the structure's body order
  HingeGaps gaps;          ///< of that state
  int steps = 0;           ///< taken
  double simulated_s = 0;  ///< time that passed in the simulation
  double seconds = 0;      ///< wall-clock time of the run
};

std::string to_string(PhysicsResult::Status status);

/// What a caller may want to see of a run while it goes on. Leave empty what is not wanted.
struct PhysicsObserver {
  std::function<void(double done)> progress;                       ///< share of the run, 0 to 1; every 1 %
  std::function<void(double simulated_s, const State& mm)> frame;  ///< from the flat state on
  double frame_interval_s = 0.02;                                  ///< simulated time between frames
};

PhysicsResult run_compression(const Structure& structure, const Drive& drive,
                              const PhysicsOptions& options = {}, const PhysicsObserver& observer = {});

}  // namespace kinetix
