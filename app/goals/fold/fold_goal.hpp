#pragma once

#include "app/goals/fold/fold_shape.hpp"
#include "app/pipeline/drive_loads.hpp"
#include "app/run/search_result.hpp"

namespace kinetix::app {

/// Loads on the drive and the hinges of a net.
struct FoldLoads {
  double theta = 0;  ///< rad
  HingeLoads hinges;
};

/// Fold section of a result.
struct FoldOutcome final : GoalOutcome {
  explicit FoldOutcome(FoldShape folded) : shape(std::move(folded)) {}

  FoldShape shape;
  std::optional<FoldLoads> loads;      ///< loads found by the search, if the file limits them
  std::optional<FoldLoads> unlimited;  ///< loads without limits, if the limits made a difference
  std::string size_error_text;         ///< size error of the box with advice; empty if the size is met

  /// Adds `fold` (faces and creases on the lattice with their angles and errors, unfoldings tried, reasons)
  /// and `optimiser`.
  void add_sections(const Run& run, nlohmann::ordered_json& result) const override;
  void add_metrics(const Run& run, nlohmann::ordered_json& metrics) const override;
  std::vector<SummaryLine> summary_lines(const Run& run) const override;
};

struct FoldMeasure final : Measure {
  targets::FoldError error;
  std::vector<double> tilt;        ///< |tilt| of the hinges of each crease, rad
  std::optional<FoldLoads> loads;  ///< set if the file limits them
};

}  // namespace kinetix::app
