#pragma once

#include <optional>

#include "app/goals/fold/crease_checks.hpp"
#include "app/run/found.hpp"
#include "optim/fold/fit_solid.hpp"
#include "targets/fold/fold_goal.hpp"

namespace kinetix::app {

/// "3-7", by the numbers of its faces.
std::string crease_name(const targets::SolidCrease& crease);

/// What a search for the net of a solid contributes to a result.
class SolidOutcome final : public GoalOutcome {
 public:
  targets::SolidGoal goal;
  optim::SolidDesign design;

  std::vector<FoldedCrease> creases(const targets::SolidError& error) const;
  /// Of the solid between the middles of its walls, mm, when it is closed.
  double edge_mm() const;

  /// Adds `fold` (faces and creases as polygons of the flat net) and `optimiser`.
  void add_sections(const Run& run, nlohmann::ordered_json& result) const override;
  void add_metrics(const Run& run, nlohmann::ordered_json& metrics) const override;
  std::vector<SummaryLine> summary_lines(const Run& run) const override;
};

class SolidMeasure final : public Measure {
 public:
  targets::SolidError error;
  std::vector<double> tilt;  ///< size of those along each crease, rad
};

}  // namespace kinetix::app
