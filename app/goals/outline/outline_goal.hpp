#pragma once

#include "app/goals/outline/outline_search.hpp"
#include "app/run/search_result.hpp"

namespace kinetix::app {

/// Outline section of a result. The goal is met if shape and area are within tolerance and no walls collide.
class OutlineOutcome final : public GoalOutcome {
 public:
  explicit OutlineOutcome(OutlineFile asked) : file(std::move(asked)) {}

  OutlineFile file;
  double turn = 0;  ///< rotation of the outline from the drawing to the lattice, rad
  optim::OutlineDesign design;
  int cuts = 0;          ///< number of cuts of the lattice that were tried
  std::vector<int> rim;  ///< bodies along the outer boundary, counter-clockwise
  /// Returns the points of the outline aligned with the panel in the model's state, mm.
  std::vector<Eigen::Vector2d> placed(double edge_mm) const;
  /// Returns the scale of the panel, mm per mm of the drawn outline. 1: the panel is as large as drawn.
  double size(double edge_mm) const { return edge_mm / design.scale; }

  /// Adds `outline` (placed outline, boundary, errors, active bounds) and `optimiser`.
  void add_sections(const Run& run, nlohmann::ordered_json& result) const override;
  void add_metrics(const Run& run, nlohmann::ordered_json& metrics) const override;
  std::vector<SummaryLine> summary_lines(const Run& run) const override;
  /// Draws the panel from above, flat and pressed, as SVG and as PNG.
  std::vector<NamedContent> pictures(const Run& run, bool for_report) const override;
};

class OutlineMeasure final : public Measure {
 public:
  targets::OutlineError error;
};

/// Describes violations of the tolerances. @param who name of the state, such as "model" or "simulation"
std::vector<std::string> violations(const OutlineFile& file, const targets::OutlineError& error,
                                    const std::string& who);

}  // namespace kinetix::app
