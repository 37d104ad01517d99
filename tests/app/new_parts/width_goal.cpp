#include <cmath>
#include <nlohmann/json.hpp>

#include "app/files/file_header.hpp"
#include "app/files/goal_settings.hpp"
#include "app/goals/registry.hpp"
#include "app/run/goal.hpp"
#include "model/lattice/lattice_motion.hpp"

/// A kind of goal in one file: a strip of one row of upright cells that folds to a width.
///
///     target: {kind: width, width_mm: 50, cells: 6, cell_mm: 10}
namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr double widest_theta = 40 * radians_per_degree;  // rad, before walls touch

const targets::KeyTable& width_keys() {
  namespace value = targets::value;
  static const targets::KeyTable target({
      targets::goal_kind_key("width"),
      {"width_mm", value::number(targets::above(0, "mm")), targets::needed, "width of the folded strip"},
      {"cells", value::integer(2, 100), targets::needed, "how many cells the strip has"},
      {"cell_mm", value::number(targets::above(0, "mm")), targets::needed, "cell edge"},
  });
  static const targets::KeyTable keys =
      file_keys({{"target", value::map(target), targets::needed, "the goal"}});
  return keys;
}

struct WidthMeasure final : Measure {
  double width_mm = 0;
};

struct WidthOutcome final : GoalOutcome {
  double required_mm = 0;

  void add_sections(const Run& run, Json& result) const override {
    result["target"] = {{"kind", "width"}, {"width_mm", required_mm}};
    result["width"] = {{"reasons", run.violations}};
  }
  void add_metrics(const Run& run, Json& metrics) const override {
    metrics["width_mm"] = measure_of<WidthMeasure>(run).width_mm;
    metrics["met"] = run.met();
  }
  std::vector<SummaryLine> summary_lines(const Run& run) const override {
    return {{"width", std::to_string(measure_of<WidthMeasure>(run).width_mm) + " mm"}};
  }
};

double width(const model::Lattice& structure, const model::State& state) {
  const auto line = column_midline(structure, state);
  return (line.back() - line.front()).norm();
}

struct WidthGoal final : Goal {
  explicit WidthGoal(const targets::Section& root) : Goal(read_name(root)) {
    const targets::Section target = root.section("target");
    target.read_needed("width_mm", "a width in mm", width_mm_);
    target.read_needed("cells", "how many", cells_);
    target.read_needed("cell_mm", "a cell's edge in mm", cell_mm_);
  }

  model::Lattice sheet() const {
    return model::make_sheet(cells_, 1, {cell_mm_, 0.08 * cell_mm_, 0.6 * cell_mm_});
  }

  Forecast forecast() const override { return {sheet()}; }

  SearchResult search(const RunOptions&) const override {
    SearchResult out;
    out.design.structure = sheet();
    const model::ExactMotion exact = exact_motion(out.design.structure);
    double narrow = widest_theta, wide = 0;
    for (int k = 0; k < 60; ++k) {
      out.theta = (narrow + wide) / 2;
      (width(out.design.structure, exact.at(out.theta)) > width_mm_ ? wide : narrow) = out.theta;
    }
    auto outcome = std::make_unique<WidthOutcome>();
    outcome->required_mm = width_mm_;
    out.tolerances = {{"width_mm", 1e-9}};
    out.goal = std::move(outcome);
    return out;
  }

  std::shared_ptr<const Measure> measure(const Run& run, StateOf of, const model::State& state,
                                         const RunOptions&) const override {
    if (of == StateOf::physics) return nullptr;
    auto out = std::make_shared<WidthMeasure>();
    out->width_mm = width(run.design.structure, state);
    if (!(std::abs(out->width_mm - width_mm_) <= 1e-9)) out->violations = {"no theta has this width"};
    return out;
  }

  double width_mm_ = 0, cell_mm_ = 0;
  int cells_ = 0;
};

// The registration of a kind of goal, as in a third-party program.
const GoalKind width_kind = {.name = "width",
                             .example = "target: {kind: width, width_mm: 50, cells: 6, cell_mm: 10}",
                             .read = [](const targets::Node& root) -> std::unique_ptr<Goal> {
                               return std::make_unique<WidthGoal>(targets::Section(root, width_keys()));
                             },
                             .table = width_keys,
                             .metrics = {{"width_mm", "mm", "width of the folded strip"}}};

[[maybe_unused]] const bool goal_registered = (add_goal_kind(width_kind), true);

}  // namespace
}  // namespace kinetix::app
