#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

namespace kinetix::app {

struct Run;

/// What a goal is judged by: keys of `tolerance:` with their values as the file has them (angles in
/// degrees).
using Tolerances = std::vector<std::pair<std::string, double>>;

/// A line of the summary: a label and a text.
using SummaryLine = std::array<std::string, 2>;

/// A file beside result.json: its path in the folder of results, and its content.
struct NamedContent {
  std::string name, content;
};

/// What a search for a goal contributes to a result; each kind of goal has its own. It does not change once the search is over.
class GoalOutcome {
 public:
  virtual ~GoalOutcome() = default;

  /// What distances of points of the sheet are from, in words.
  virtual std::string judged_against() const { return "the goal"; }

  /// Whether its columns alone say where something is in the sheet.
  virtual bool is_strip() const { return false; }

  /// The section `target` of result.json, with the key `kind`.
  virtual nlohmann::ordered_json target_json() const = 0;
  /// Adds the kind's own section and `optimiser`. @param run the run that this is the outcome of
  virtual void add_sections(const Run& run, nlohmann::ordered_json& result) const = 0;
  /// Adds the metrics that the kind names (GoalKind::metrics) to `metrics`.
  virtual void add_metrics(const Run& run, nlohmann::ordered_json& metrics) const = 0;
  virtual std::vector<SummaryLine> summary_lines(const Run& run) const = 0;
  /// What a person should know of the goal and what leaves it met, a sentence each. @param run as above
  virtual std::vector<std::string> warnings(const Run& /*run*/) const { return {}; }
  virtual std::vector<NamedContent> pictures(const Run&) const { return {}; }
  /// PNG files that the report itself shows.
  virtual std::vector<NamedContent> shown_pictures(const Run&) const { return {}; }

 protected:
  GoalOutcome() = default;
  GoalOutcome(const GoalOutcome&) = default;
  GoalOutcome(GoalOutcome&&) = default;
  GoalOutcome& operator=(const GoalOutcome&) = default;
  GoalOutcome& operator=(GoalOutcome&&) = default;
};

}  // namespace kinetix::app
