#pragma once

#include "app/run/plan.hpp"
#include "app/run/run.hpp"
#include "app/run/run_options.hpp"
#include "model/lattice/lattice.hpp"
#include "model/linkage/state.hpp"
#include "targets/document/edit_document.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// Goal of a target: finds a design for it, and measures how far any state of a design is from it.
class Goal {
 public:
  explicit Goal(std::string name_of_results) : name(std::move(name_of_results)) {}
  virtual ~Goal() = default;

  const std::string name;  ///< names folders of results

  /// Goal of the same file with other cells or values.
  struct Changed {
    std::shared_ptr<const Goal> goal;
    std::string keys;            ///< of the file that differ, in YAML: "structure: {cell_mm: 12.5}"
    bool changes_given = false;  ///< whether the file itself gives one of them
  };
  /// Reads the file again with cells of another size, mm, on top of the changes so far. Empty if the goal does not allow
  /// it. Not set for goals that were not read from a file. @param before size of its cells, mm
  std::function<std::optional<Changed>(const model::CellSize& before, const model::CellSize& size)> resize =
      {};
  /// Reads the file again with other values. Not set for goals that were not read from a file.
  /// @throws InvalidInput for values that the goal does not allow
  std::function<Changed(const targets::DocumentChanges&)> change = {};

  /// Returns estimates that need no search.
  virtual Forecast forecast() const = 0;
  /// Searches for a design. @throws InvalidInput for a target that leaves nothing to search
  virtual SearchResult search(const RunOptions& options) const = 0;
  /// Measures how far a state is from the goal. Null for states that the kind does not judge.
  /// @param run as far as it is computed   @param state anywhere in space; of the model: Found::own
  virtual std::shared_ptr<const Measure> measure(const Run& run, StateOf of, const model::State& state,
                                                 const RunOptions& options) const = 0;

  /// Returns changes of the file that may bring a design nearer that misses the goal, small ones first.
  virtual std::vector<targets::DocumentChanges> remedies(const Run& /*missed*/) const { return {}; }

  /// Points by which the goal is judged, and the limit of their rms.
  struct Observed {
    std::vector<model::ObservedPoint> points;
    double tolerance_mm = 0;
  };
  /// Returns how far points of a state are from the goal. Empty for goals that are not judged by distances.
  /// @param found planned   @param sheet that the state belongs to: the design's, or one with other hinges
  /// @param state anywhere in space; points are in its own frame
  virtual std::optional<Observed> observe(const SearchResult& /*found*/, const model::Lattice& /*sheet*/,
                                          const model::State& /*state*/) const {
    return std::nullopt;
  }
};

/// Number under `metrics` in result.json.
struct GoalMetric {
  std::string_view name;
  std::string_view unit;          ///< empty for ratios, counts and truth values
  std::string_view meaning = {};  ///< for the documentation, in Markdown
};

/// Number that measures how far any state is from a goal, without a search. Its name ends in its unit, if it has one.
struct GoalMeasure {
  std::string_view name;
  double (*of)(const Goal& goal, const model::Lattice& structure, const model::State& state);
};

/// File that a target of a kind names.
struct GoalFile {
  std::string_view key;   ///< of the section `target`
  std::string_view form;  ///< header of a table of points ("x,z"), "picture" or "mesh"
};

/// Kind of goal: how its targets are read, and what the program must know about all of them.
struct GoalKind {
  std::string_view name;              ///< `target.kind`
  std::string_view example;           ///< the shortest `target:` of this kind
  std::string_view meaning = {};      ///< for the list of kinds, a noun phrase
  std::optional<GoalFile> file = {};  ///< that its targets name; empty: none
  /// Reads a target. @param root a target of this kind @throws InvalidInput for all that the format does not allow
  std::unique_ptr<Goal> (*read)(const targets::Node& root);
  /// Returns every key of its files.
  const targets::KeyTable& (*table)();
  Model model = Model::exact;       ///< source of its states
  std::vector<GoalMetric> metrics;  ///< entries that its searches add to `metrics`
  std::vector<GoalMeasure> measures = {};
  bool keeps_length =
      false;  ///< whether larger cells are fewer, since the goal gives a length; else sheets grow
  /// Columns and rows of kinds that keep a length, if the file gives neither them nor their size. Empty: a cell size
  /// sets them.
  std::optional<std::array<int, 2>> usual_cells = {};
};

/// Goal that was read, with its kind.
struct Target {
  const GoalKind* kind = nullptr;
  std::shared_ptr<const Goal> goal;
};

/// Returns the mean position (x, z) of the bodies of each column, mm.
inline std::vector<Eigen::Vector2d> column_midline(const model::Lattice& structure,
                                                   const model::State& state) {
  std::vector<Eigen::Vector2d> points;
  for (const std::vector<int>& column : body_columns(structure)) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const int b : column) sum += Eigen::Vector2d(state[b].p.x(), state[b].p.z());
    points.push_back(sum / static_cast<double>(column.size()));
  }
  return points;
}

}  // namespace kinetix::app
