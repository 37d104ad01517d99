#pragma once

#include "app/goals/fold/fold_shape.hpp"
#include "app/pipeline/hinge_loads.hpp"
#include "app/run/found.hpp"

namespace kinetix::app {

/// What a net asks of its drive and its hinges.
struct FoldLoads {
  double theta = 0;  ///< rad
  HingeLoads hinges;
};

/// What a search for a fold contributes to a result.
struct FoldOutcome final : GoalOutcome {
  explicit FoldOutcome(FoldShape folded) : shape(std::move(folded)) {}

  FoldShape shape;
  std::optional<FoldLoads> loads;      ///< as the search has them, where the file limits them
  std::optional<FoldLoads> unlimited;  ///< what it would be without limits, where they made a difference
  std::string
      size_missed;  ///< how far the box is from its size and what to do about it; empty where it is met

  /// Adds `fold` (faces and creases on the lattice with their angles and errors, unfoldings tried, reasons)
  /// and `optimiser`.
  void add_sections(const Run& run, nlohmann::ordered_json& result) const override;
  void add_metrics(const Run& run, nlohmann::ordered_json& metrics) const override;
  std::vector<SummaryLine> summary_lines(const Run& run) const override;
};

struct FoldMeasure final : Measure {
  targets::FoldError error;
  std::vector<double> tilt;        ///< size of those along each crease, rad
  std::optional<FoldLoads> loads;  ///< where the file limits them
};

}  // namespace kinetix::app
