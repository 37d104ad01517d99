#include "app/pipeline/robust_search.hpp"

#include <fmt/format.h>

#include "app/pipeline/equilibrium.hpp"
#include "app/pipeline/pipeline.hpp"
#include "app/pipeline/print_tolerance.hpp"
#include "app/run/design_hinges.hpp"

namespace kinetix::app {
namespace {

// Ratios of the tried gaps of blocks and films to the file's. Longer ones turn softer and are weaker across.
constexpr double gap_shares[] = {1, 0.7, 1.4};

/// Tolerance of a goal and expected error of its prints.
struct Expected {
  double tolerance_mm = 0;
  PrintedGoal printed;
  bool hinges_withstand = true;  ///< withstand their strain
};

/// Returns the expected error of prints of a run that has been through its models; empty if it is not known.
std::optional<Expected> expected(const Run& run, const Goal& goal) {
  if (run.compensation && !run.equilibrium) return std::nullopt;
  const model::State& state = run.compensation ? run.equilibrium->path.state : run.own;
  const auto observed = goal.observe(run, run.design.structure, state);
  if (!observed) return std::nullopt;
  const auto drive =
      run.compensation ? run.equilibrium->drive : goal_drive(run, run.design.structure, run.theta);
  const auto printed = estimate_print_tolerance(run, drive, state, observed->points);
  if (!printed) return std::nullopt;
  return Expected{observed->tolerance_mm, *printed, withstands_strain(run.design, state)};
}

/// Lists the trials, the plain search first.
std::vector<RobustTrial> trials(const std::optional<optim::AngleRange>& theta, const HingeSection& hinge) {
  std::vector<RobustTrial> out = {{std::nullopt, hinge}};
  for (const double share : gap_shares) {
    if (share != 1 && !has_gap(hinge)) continue;
    HingeSection other = hinge;
    if (has_gap(hinge)) other.made->gap_mm *= share;
    if (!theta) {
      if (share != 1) out.push_back({std::nullopt, other});
      continue;
    }
    for (int k = 0; k < robust_thetas; ++k) {
      const double lower =
          theta->lower + (theta->upper - theta->lower - narrow_theta) * k / (robust_thetas - 1);
      out.push_back({optim::AngleRange{lower, lower + narrow_theta}, other});
    }
  }
  return out;
}

std::string describe_violation(const Run& run) {
  return run.compensation ? "its elastic hinges miss the goal" : "it misses the goal";
}

/// Returns why a design is not allowed; empty if it is.
std::string describe_rejection(const Run& run, const Expected& found, const RunOptions& options) {
  if (!run.met()) return describe_violation(run);
  if (!(found.printed.made.designed_mm <= found.tolerance_mm)) return "it is too far off the goal";
  if (!found.printed.can_be_printed) return "the process cannot print it";
  if (!found.hinges_withstand) return "its hinges are strained beyond the limit of their material";
  if (!options.printable) return "";
  const PrintAnswer print = options.printable(written_design(run));
  if (!print.is_accepted) return "it cannot be printed: " + print.why;
  const bool has_joints = run.design.hinge.model == HingeSection::Model::rotary;
  return has_joints && !has_pins_alone(run.design) ? "pins do not fit it, and soft hinges seldom fold" : "";
}

/// Evaluates a trial. @param plain result of the plain search
RobustCandidate tried(const SearchResult& plain, const Goal& goal, const RobustTrial& trial,
                      const RobustSolve& solve, const RunOptions& options) {
  try {
    return robust_candidate(solve(trial, options), goal, options);
  } catch (const InvalidInput& e) {
    RobustCandidate out = unevaluated_candidate(trial.theta ? trial.theta->lower : plain.theta,
                                                plain.design.structure.size().edge_mm, trial.hinge);
    out.why_not = "it cannot be made: " + e.reason();
    return out;
  }
}

}  // namespace

bool has_gap(const HingeSection& hinge) { return hinge.made && hinge.made->gap_mm > 0; }

RobustCandidate unevaluated_candidate(double theta, double cell_mm, const HingeSection& hinge) {
  RobustCandidate out{.theta = theta,
                      .cell_mm = cell_mm,
                      .designed_mm = std::nan(""),
                      .printed_mm = std::nan(""),
                      .printed_p95_mm = std::nan("")};
  if (has_gap(hinge)) out.gap_mm = hinge.made->gap_mm;
  return out;
}

SearchResult with_printed_hinges(SearchResult found, const RunOptions& options) {
  const bool has_joints = found.design.hinge.model == HingeSection::Model::rotary;
  if (!options.printable || !has_joints || !leaves_hinges_open(found.design)) return found;
  const PrintAnswer answer = options.printable(requested_design(found));
  if (answer.is_accepted) found.design = with_manufactured_hinges(found.design, answer.made);
  return found;
}

RobustCandidate robust_candidate(SearchResult found, const Goal& goal, const RunOptions& options) {
  found = with_printed_hinges(std::move(found), options);
  RobustCandidate out =
      unevaluated_candidate(found.theta, found.design.structure.size().edge_mm, found.design.hinge);
  Run run = held(std::move(found), &goal, options);
  out.why_not = describe_violation(run);
  if (!run.met()) return out;
  run = settled(std::move(run), goal, options);
  const auto prints = expected(run, goal);
  out.why_not = run.met() ? "its print tolerance is unknown" : describe_violation(run);
  if (!prints) return out;
  const model::ToleranceResult& made = prints->printed.made;
  out.designed_mm = made.designed_mm;
  out.printed_mm = made.rms_mm;
  out.printed_p95_mm = made.p95_mm;
  out.why_not = describe_rejection(run, *prints, options);
  out.is_allowed = out.why_not.empty();
  return out;
}

SearchResult search_robustly(SearchResult plain, const Goal& goal, double weight,
                             const std::optional<optim::AngleRange>& theta, const RobustSolve& solve,
                             const RunOptions& options) {
  RunOptions quiet = options;
  quiet.progress = {};
  RobustChoice choice;
  const std::vector<RobustTrial> all = trials(theta, plain.design.hinge);
  for (std::size_t k = 0; k < all.size() && !options.stop.stop_requested(); ++k) {
    options.progress("robust search", static_cast<double>(k) / static_cast<double>(all.size()),
                     fmt::format("design {} of {}", k + 1, all.size()));
    RobustCandidate next = tried(plain, goal, all[k], solve, quiet);
    if (options.stop.stop_requested()) break;  // the trial was cut short and is not valid
    choice.tried.push_back(std::move(next));
    if (is_more_robust(weight, choice.tried.back(), choice.tried[choice.chosen])) choice.chosen = k;
  }
  if (choice.tried.empty()) return plain;
  quiet.stop = {};  // solves the chosen design in full, even after a stop request
  SearchResult best = choice.chosen > 0 ? solve(all[choice.chosen], quiet) : std::move(plain);
  best.robust = std::move(choice);
  return best;
}

int designs_of_robust_search(const std::optional<optim::AngleRange>& theta, const HingeSection& hinge) {
  return static_cast<int>(trials(theta, hinge).size());
}

}  // namespace kinetix::app
