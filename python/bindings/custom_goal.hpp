#pragma once

#include "app/run/goal.hpp"
#include "optim/curve/fit_curve.hpp"
#include "python/bindings/custom_fit.hpp"

namespace kinetix::python {

/// User's goal: the size of the strip, what the search may vary, and when the goal is met.
class CustomGoal final : public app::Goal {
 public:
  using Goal::Goal;

  std::shared_ptr<const CustomError> error;
  double tolerance = 0;  ///< of the root of the sum of squares of the residuals, in units of the error
  optim::CurveVariables allowed;  ///< of the strip
  model::CellSize size;
  optim::MultiStartOptions starts = {};

  /// @throws InvalidInput if nothing is left to search
  CustomFit fit() const;

  app::Forecast forecast() const override;
  app::SearchResult search(const app::RunOptions& options) const override;
  /// Measures the error of the model's state, or of the final state of the simulation aligned with it.
  std::shared_ptr<const app::Measure> measure(const app::Run& run, app::StateOf of, const model::State& state,
                                              const app::RunOptions& options) const override;
};

}  // namespace kinetix::python
