#include "app/pipeline/robust_search.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "app/pipeline/as_made.hpp"
#include "app/pipeline/matter.hpp"
#include "app/run/design_hinges.hpp"

namespace kinetix::app {
namespace {

// What is tried of theta: its whole range, in equal steps.
constexpr int thetas = 9;
// rad: as narrow as a range may be; theta is what is tried.
constexpr double narrow = 1e-3;
// And of the gaps of blocks and films, over that of the file: longer ones turn softer, and are weaker across.
constexpr double gap_shares[] = {1, 0.7, 1.4};

/// How the goal is kept, and what prints are expected to come to.
struct Expected {
  double tolerance_mm = 0;
  PrintedGoal printed;
  bool hinges_bear = true;  ///< their strain
};

/// Of a run that was solved, which goes as far as the pipeline takes it without a physics run.
std::optional<Expected> expected(Run& run, const Scene& scene, const RunOptions& options) {
  run.design.own_hinges = own_hinges_of(run.design.structure, run.hinge_parts);
  run.plan = make_plan(run.design.structure, scene.model());
  scene.add_state(run, options);
  scene.judge(run, options);
  if (is_of_matter(scene, run)) settle_in_matter(run, scene, options);
  if (run.matter && !run.equilibrium) return std::nullopt;
  const model::State state = run.matter ? run.equilibrium->path.state : scene.own_state(run);
  const auto goal = scene.judged(run, run.design.structure, state);
  if (!goal) return std::nullopt;
  const auto drive = run.matter ? run.equilibrium->drive : goal_drive(run, run.design.structure, run.theta);
  const auto printed = expected_of_prints(run, drive, state, goal->points);
  if (!printed) return std::nullopt;
  return Expected{goal->tolerance_mm, *printed, bears_its_strain(run.design, state)};
}

/// The plain search first.
std::vector<RobustTrial> trials(const std::optional<optim::AngleRange>& theta, const HingeSection& hinge) {
  std::vector<RobustTrial> out = {{std::nullopt, hinge}};
  const bool has_gap = hinge.made && hinge.made->gap_mm > 0;
  for (const double share : gap_shares) {
    if (share != 1 && !has_gap) continue;
    HingeSection other = hinge;
    if (has_gap) other.made->gap_mm *= share;
    if (!theta) {
      if (share != 1) out.push_back({std::nullopt, other});
      continue;
    }
    for (int k = 0; k < thetas; ++k) {
      const double lower = theta->lower + (theta->upper - theta->lower - narrow) * k / (thetas - 1);
      out.push_back({optim::AngleRange{lower, lower + narrow}, other});
    }
  }
  return out;
}

void take_over(Run& run, Run&& better) {
  run.design.structure = std::move(better.design.structure);
  run.design.hinge = std::move(better.design.hinge);
  run.theta = better.theta;
  run.goal = std::move(better.goal);
}

RobustCandidate not_judged(double theta, double cell_mm, const HingeSection& hinge) {
  RobustCandidate out{.theta = theta,
                      .cell_mm = cell_mm,
                      .designed_mm = std::nan(""),
                      .as_made_mm = std::nan(""),
                      .as_made_p95 = std::nan("")};
  if (hinge.made && hinge.made->gap_mm > 0) out.gap_mm = hinge.made->gap_mm;
  return out;
}

std::string missed_in_words(const Run& run) {
  return run.matter ? "its elastic hinges miss the goal" : "it misses the goal";
}

/// Empty where it may be taken.
std::string why_not_taken(const Run& run, const Expected& found, const RunOptions& options) {
  if (!run.goal->met()) return missed_in_words(run);
  if (!(found.printed.made.designed_mm <= found.tolerance_mm)) return "it is too far off the goal";
  if (!found.printed.can_be_printed) return "the process cannot print it";
  if (!found.hinges_bear) return "its hinges are strained by more than their material bears";
  if (!options.printable) return "";
  const PrintAnswer print = options.printable(written_design(run));
  return print.is_taken ? "" : "it cannot be printed: " + print.why;
}

/// @param plain what the plain search found
RobustCandidate tried(const Run& plain, const Scene& scene, const RobustTrial& trial,
                      const RobustSolve& solve, const RunOptions& options) {
  try {
    Run run;
    solve(run, trial, options);
    return robust_candidate(std::move(run), scene, options);
  } catch (const InvalidInput& e) {
    RobustCandidate out = not_judged(trial.theta ? trial.theta->lower : plain.theta,
                                     plain.design.structure.size().edge_mm, trial.hinge);
    out.why_not = "it cannot be made: " + e.reason();
    return out;
  }
}

}  // namespace

RobustCandidate robust_candidate(Run run, const Scene& scene, const RunOptions& options) {
  RobustCandidate out = not_judged(run.theta, run.design.structure.size().edge_mm, run.design.hinge);
  out.why_not = missed_in_words(run);
  if (!run.goal->met()) return out;
  const auto found = expected(run, scene, options);
  out.why_not = run.goal->met() ? "what its prints come to is not known" : missed_in_words(run);
  if (!found) return out;
  const model::AsMade& made = found->printed.made;
  out.designed_mm = made.designed_mm;
  out.as_made_mm = made.rms_mm;
  out.as_made_p95 = made.p95_mm;
  out.why_not = why_not_taken(run, *found, options);
  out.is_allowed = out.why_not.empty();
  return out;
}

void search_robustly(Run& run, const Scene& scene, double weight,
                     const std::optional<optim::AngleRange>& theta, const RobustSolve& solve,
                     const RunOptions& options) {
  RunOptions quiet = options;
  quiet.progress = {};
  RobustChoice choice;
  const std::vector<RobustTrial> all = trials(theta, run.design.hinge);
  for (std::size_t k = 0; k < all.size() && !options.stop.stop_requested(); ++k) {
    options.progress("robust search", static_cast<double>(k) / static_cast<double>(all.size()),
                     fmt::format("design {} of {}", k + 1, all.size()));
    RobustCandidate next = tried(run, scene, all[k], solve, quiet);
    if (options.stop.stop_requested()) break;  // cut short, it says nothing of that design
    choice.tried.push_back(std::move(next));
    if (is_more_robust(weight, choice.tried.back(), choice.tried[choice.chosen])) choice.chosen = k;
  }
  if (choice.tried.empty()) return;
  if (choice.chosen > 0) {
    quiet.stop = {};  // the design that was found, not what a search that is stopped at once has
    Run better;
    solve(better, all[choice.chosen], quiet);
    take_over(run, std::move(better));
  }
  run.robust = std::move(choice);
}

int designs_of_robust_search(const std::optional<optim::AngleRange>& theta, const HingeSection& hinge) {
  return static_cast<int>(trials(theta, hinge).size());
}

}  // namespace kinetix::app
