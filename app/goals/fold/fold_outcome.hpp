#pragma once

#include <optional>
#include "app/goals/fold/crease_checks.hpp"

#include "app/run/found.hpp"
#include "app/run/hinge_loads.hpp"
#include "optim/fold/fit_fold.hpp"

namespace kinetix::app {

/// What a net asks of its drive and its hinges.
struct FoldLoads {
  double theta = 0;  ///< rad
  HingeLoads hinges;
};

/// What a search for a fold contributes to a result.
class FoldOutcome final : public GoalOutcome {
 public:
  targets::FoldGoal goal;
  optim::FoldDesign design;
  std::optional<FoldLoads> loads;      ///< as the search has them, where the file limits them
  std::optional<FoldLoads> unlimited;  ///< what it would be without limits, where they made a difference
  std::string instead;                 ///< what to do about the size of the box, where it is not met

  std::vector<FoldedCrease> creases(const targets::FoldError& error) const;
  /// Edges of the ideal box, mm: faces, and what the creases add at their ends, to the rim of an open one. @pre goal.box
  std::array<double, 3> edges_mm() const;

  /// Adds `fold` (faces and creases on the lattice with their angles and errors, unfoldings tried, reasons)
  /// and `optimiser`.
  void add_sections(const Run& run, nlohmann::ordered_json& result) const override;
  void add_metrics(const Run& run, nlohmann::ordered_json& metrics) const override;
  std::vector<SummaryLine> summary_lines(const Run& run) const override;
};

class FoldMeasure final : public Measure {
 public:
  targets::FoldError error;
  std::vector<double> tilt;        ///< size of those along each crease, rad
  std::optional<FoldLoads> loads;  ///< where the file limits them
};

}  // namespace kinetix::app
