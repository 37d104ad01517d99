#pragma once

#include <optional>
#include <string>

#include "app/run/run_options.hpp"
#include "app/run/scene.hpp"

namespace kinetix::app {

/// What is said of a design beside its physics run.
struct Judgement {
  std::optional<PrintedGoal> printed;  ///< of goals that are judged by distances
  std::string prints_unknown;          ///< why there is none, of such goals; else empty
  std::optional<Certified> certified;  ///< where the options ask for it
  double as_made_s = 0, certify_s = 0;
};

/// Looks at a run and changes nothing of it, so that a physics run may go on beside it. Leaves out what is still to do
/// when it is told to stop. Reports progress from the thread that it runs on.
/// @pre the run has its plan, its state and, of elastic hinges, its equilibrium
Judgement judgement(const Run& run, const Scene& scene, const RunOptions& options);

/// Adds it to the run: ranges of theta that samples took for free end where walls are proven to meet, and a goal that lies
/// beyond is missed.
void add(Judgement judgement, Run& run);

}  // namespace kinetix::app
