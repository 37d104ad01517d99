#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <utility>

#include "app/io/atomic_file.hpp"

namespace kinetix::app {

struct Run;

/// Tolerances of a goal: keys of `tolerance:` with their values as in the file (angles in degrees).
using Tolerances = std::vector<std::pair<std::string, double>>;

/// Line of the summary: a label and a text.
using SummaryLine = std::array<std::string, 2>;

/// Contribution of a search to a result; each kind of goal has its own. It does not change once the search is over.
class GoalOutcome {
 public:
  virtual ~GoalOutcome() = default;

  /// Adds the sections of the kind: `target` with the key `kind`, its own section, `optimiser`.
  /// @param run the run with this outcome
  virtual void add_sections(const Run& run, nlohmann::ordered_json& result) const = 0;
  /// Adds the metrics that the kind names (GoalKind::metrics) to `metrics`.
  virtual void add_metrics(const Run& run, nlohmann::ordered_json& metrics) const = 0;
  /// Returns the kind's lines of the summary. The first gives the distance from the goal and its limit; the short form
  /// shows it. It also shows a line `print`, of a kind that judges prints itself.
  virtual std::vector<SummaryLine> summary_lines(const Run& run) const = 0;
  /// Returns PNG pictures. @param for_report only those that the report itself shows
  virtual std::vector<NamedContent> pictures(const Run& /*run*/, bool /*for_report*/) const { return {}; }

 protected:
  GoalOutcome() = default;
  GoalOutcome(const GoalOutcome&) = default;
  GoalOutcome(GoalOutcome&&) = default;
  GoalOutcome& operator=(const GoalOutcome&) = default;
  GoalOutcome& operator=(GoalOutcome&&) = default;
};

}  // namespace kinetix::app
