#pragma once

#include "app/goals/curve/robust_curve.hpp"
#include "app/run/found.hpp"
#include "optim/curve/fit_curve.hpp"

namespace kinetix::app {

/// What a curve search contributes to a result. Met: shape within tolerance, and no walls in the way.
class CurveOutcome final : public GoalOutcome {
 public:
  std::vector<Eigen::Vector2d> target_mm;  ///< as given
  optim::FreeCurveDesign found;
  std::optional<RobustCurve> robust;  ///< where `found` was chosen by what its prints come to
  optim::SolverOptions solver;
  double shape_tolerance = 0.01;  ///< of found.design.error.rms, over the diagonal of the goal

  /// Adds `curve` and `optimiser`.
  void add_sections(const Run& run, nlohmann::ordered_json& result) const override;
  void add_metrics(const Run& run, nlohmann::ordered_json& metrics) const override;
  std::vector<SummaryLine> summary_lines(const Run& run) const override;
};

class CurveMeasure final : public Measure {
 public:
  std::vector<Eigen::Vector2d> midline_mm;  ///< (x, z), as the model's state lies
  targets::CurveError error;
};

}  // namespace kinetix::app
