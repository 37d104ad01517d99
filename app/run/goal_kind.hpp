#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/run/goal.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// A number under `metrics` in result.json.
struct GoalMetric {
  std::string_view name;
  std::string_view unit;          ///< empty for ratios, counts and truth values
  std::string_view meaning = {};  ///< for the documentation, in Markdown
};

/// A number that tells how far any state is from a goal, without a search; its name ends in its unit, if it
/// has one.
struct GoalMeasure {
  std::string_view name;
  double (*of)(const Goal& goal, const model::Sheet& structure, const model::State& state);
};

/// A kind of goal: how targets of it are read, and what else the program has to know of all of them.
struct GoalKind {
  std::string_view name;     ///< `target.kind`
  std::string_view example;  ///< the shortest `target:` of it
  /// @param root a target of this kind. @throws InvalidInput for whatever the format does not allow
  std::unique_ptr<Goal> (*read)(const targets::Node& root);
  /// Every key of its files.
  const targets::KeyTable& (*table)();
  Model model = Model::exact;       ///< that its states come from
  std::vector<GoalMetric> metrics;  ///< that its searches add to `metrics`
  std::vector<GoalMeasure> measures = {};
};

/// A goal that was read.
struct Target {
  const GoalKind* kind = nullptr;
  std::shared_ptr<const Goal> goal;
};

}  // namespace kinetix::app
