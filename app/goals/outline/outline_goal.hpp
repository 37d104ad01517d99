#pragma once

#include <optional>

#include "app/goals/outline/search_outline.hpp"
#include "app/run/found.hpp"

namespace kinetix::app {

/// What a search for an outline contributes to a result. Met: shape and area within tolerance, no walls in the way.
class OutlineOutcome final : public GoalOutcome {
 public:
  explicit OutlineOutcome(OutlineFile asked) : file(std::move(asked)) {}

  OutlineFile file;
  double turn = 0;  ///< of the outline as it lies on the lattice from where it was drawn, rad
  optim::OutlineDesign design;
  int cuts = 0;          ///< of the lattice that were tried
  std::vector<int> rim;  ///< bodies round the outside, counter-clockwise
  /// Points of the outline where the panel in the model's state should lie on it, mm.
  std::vector<Eigen::Vector2d> placed(double edge_mm) const;
  /// mm of the panel a mm of the outline: 1 where the panel comes out as large as drawn.
  double size(double edge_mm) const { return edge_mm / design.scale; }

  /// Adds `outline` (placed outline, rim, errors, what binds) and `optimiser`.
  void add_sections(const Run& run, nlohmann::ordered_json& result) const override;
  void add_metrics(const Run& run, nlohmann::ordered_json& metrics) const override;
  std::vector<SummaryLine> summary_lines(const Run& run) const override;
  /// The panel from above, flat and pressed, as SVG and as PNG.
  std::vector<NamedContent> pictures(const Run& run, bool of_report) const override;
};

class OutlineMeasure final : public Measure {
 public:
  targets::OutlineError error;
};

/// What a state lacks, in words. @param who "model" or "physics run"
std::vector<std::string> violations(const OutlineFile& file, const targets::OutlineError& error,
                                    const std::string& who);

}  // namespace kinetix::app
