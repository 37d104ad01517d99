#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/run/forecast.hpp"
#include "app/run/run.hpp"
#include "app/run/run_options.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// The goal of a target: how a design is found for it, and how far any state of a design is from it.
class Goal {
 public:
  explicit Goal(std::string name_of_results) : name(std::move(name_of_results)) {}
  virtual ~Goal() = default;

  const std::string name;  ///< names folders of results

  /// What can be said without a search.
  virtual Forecast forecast() const = 0;
  /// @throws InvalidInput for a target that leaves nothing to search
  virtual Found search(const RunOptions& options) const = 0;
  /// How far a state is from the goal. Nothing of states that the kind does not judge.
  /// @param run as far as it has come   @param state anywhere in space; of the model: Found::own
  virtual std::shared_ptr<const Measure> measure(const Run& run, StateOf of, const model::State& state,
                                                 const RunOptions& options) const = 0;

  /// The points by which the goal is judged, and what their rms may be.
  struct Observed {
    std::vector<model::ObservedPoint> points;
    double tolerance_mm = 0;
  };
  /// How far points of a state are from the goal. Nothing of goals that are not judged by distances.
  /// @param found planned   @param sheet that the state is of: the design's, or one with other hinges
  /// @param state anywhere in space; points are in its own frame
  virtual std::optional<Observed> observe(const Found& /*found*/, const model::Lattice& /*sheet*/,
                                          const model::State& /*state*/) const {
    return std::nullopt;
  }
};

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
  double (*of)(const Goal& goal, const model::Lattice& structure, const model::State& state);
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
