#include <fmt/format.h>
#include <cmath>

#include "app/pipeline/pipeline.hpp"

namespace kinetix::app {
namespace {

constexpr double clearly_nearer = 0.9;  // ratio of distances: less is not worth a change of the file

bool is_exported(const Run& run) { return !run.print || run.print->is_accepted; }

/// Run of the goal's file with some changes.
struct RemedyTrial {
  std::string keys;
  Run run;
};

/// Runs the file with changes; empty if the goal does not allow them, or if a stop leaves nothing to keep.
std::optional<RemedyTrial> try_remedy(const Goal& goal, const targets::DocumentChanges& changes,
                                      const RunOptions& options) try {
  const Goal::Changed changed = goal.change(changes);
  return RemedyTrial{changed.keys, run_goal(*changed.goal, options)};
} catch (const InvalidInput&) {
  return std::nullopt;
} catch (const Interrupted&) {
  return std::nullopt;
}

/// Checks that a trial lacks nothing that the missed run has.
bool is_at_least_as_good(const Run& trial, const Run& missed) {
  return (is_exported(trial) || !is_exported(missed)) && trial.violations.size() <= missed.violations.size();
}

}  // namespace

std::string find_remedy(const Goal& goal, const Run& missed, RunOptions options) {
  if (!goal.change || !options.seeks_remedy || missed.stopped || missed.met() || missed.states.empty())
    return "";
  const std::vector<targets::DocumentChanges> remedies = goal.remedies(missed);
  const Progress progress = options.progress;
  options.progress = {};
  options.verify = options.fidelity = false;
  options.prints = 0;
  options.brief = true;
  options.seeks_remedy = false;
  double least = clearly_nearer * shown_measure(missed).distance;
  std::string best;
  int tried = 0;
  for (const targets::DocumentChanges& changes : remedies) {
    if (options.stop.stop_requested()) return "";
    progress("other settings", static_cast<double>(tried) / static_cast<double>(remedies.size()));
    const std::optional<RemedyTrial> trial = try_remedy(goal, changes, options);
    ++tried;
    if (!trial || !is_at_least_as_good(trial->run, missed)) continue;
    if (trial->run.met()) return fmt::format("With `{}` the goal is met", trial->keys);
    const double distance = shown_measure(trial->run).distance;
    if (!(distance < least)) continue;
    least = distance;
    best = trial->keys;
  }
  if (tried == 0) return "";
  if (best.empty()) return fmt::format("None of {} other settings that were searched is nearer", tried);
  return fmt::format(
      "`{}` is the nearest of {} other settings that were searched, at {:.3g} times the tolerance", best,
      tried, least);
}

}  // namespace kinetix::app
