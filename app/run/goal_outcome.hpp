#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/io/atomic_file.hpp"

namespace kinetix::app {

struct Run;

/// What a goal is judged by: keys of `tolerance:` with their values as the file has them (angles in
/// degrees).
using Tolerances = std::vector<std::pair<std::string, double>>;

/// A line of the summary: a label and a text.
using SummaryLine = std::array<std::string, 2>;

/// What a search for a goal contributes to a result; each kind of goal has its own. It does not change once the search is over.
class GoalOutcome {
 public:
  virtual ~GoalOutcome() = default;

  /// Adds what the kind says of the run: `target` with the key `kind`, its own section, `optimiser`. @param run that this is the
  /// outcome of
  virtual void add_sections(const Run& run, nlohmann::ordered_json& result) const = 0;
  /// Adds the metrics that the kind names (GoalKind::metrics) to `metrics`.
  virtual void add_metrics(const Run& run, nlohmann::ordered_json& metrics) const = 0;
  virtual std::vector<SummaryLine> summary_lines(const Run& run) const = 0;
  /// @param of_report those alone that the report itself shows, PNG
  virtual std::vector<NamedContent> pictures(const Run& /*run*/, bool /*of_report*/) const { return {}; }

 protected:
  GoalOutcome() = default;
  GoalOutcome(const GoalOutcome&) = default;
  GoalOutcome(GoalOutcome&&) = default;
  GoalOutcome& operator=(const GoalOutcome&) = default;
  GoalOutcome& operator=(GoalOutcome&&) = default;
};

}  // namespace kinetix::app
