#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "app/run/goal.hpp"
#include "app/run/run_options.hpp"

namespace kinetix::app {

/// What is said of a design beside its physics run.
struct Judgement {
  std::optional<PrintedGoal> printed;     ///< of goals that are judged by distances
  std::string prints_unknown;             ///< why there is none, of such goals; else empty
  std::optional<ProvenRanges> certified;  ///< where the options ask for it
  std::optional<PrintAnswer> print;       ///< of `export`, where there is a goal and the options ask for it
  double as_made_s = 0, certify_s = 0;
};

/// Comes to a judgement in parts, which threads take as they become free: what prints come to, where walls meet, what `export`
/// answers. Looks at a run and changes nothing of it, so that a physics run may go on beside it.
class Judging {
 public:
  /// @param run, options are kept by reference   @param goal null for a design
  /// @pre the run has its plan, its state and, of elastic hinges, its equilibrium
  Judging(const Run& run, const Goal* goal, const RunOptions& options);
  /// Does parts that no thread has begun, until none is left or the options say stop. Any number of threads may be in it.
  void work();
  /// @pre every work() has returned
  const Judgement& judgement() const { return found_; }

 private:
  void judge_prints();
  void prove_range();
  void ask_export();

  const Run& run_;
  const Goal* goal_;
  const RunOptions& options_;
  std::atomic<int> begun_ = 0;
  Judgement found_;  ///< each part writes fields of its own
};

/// The run with its judgement: ranges of theta that samples took for free end where walls are proven to meet, and a goal that
/// lies beyond is missed. So is one whose walls overlap as built, where nothing was to be proven as well.
Run with_judgement(Run run, Judgement judgement);

}  // namespace kinetix::app
