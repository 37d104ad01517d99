#pragma once

#include <memory>

#include "app/run/goal.hpp"
#include "optim/curve/fit_curve.hpp"
#include "python/bindings/own_fit.hpp"

namespace kinetix::python {

/// A goal of one's own: how large the strip is, what the search may vary, and when the goal is met.
class OwnGoal final : public app::Goal {
 public:
  using Goal::Goal;

  std::shared_ptr<const OwnError> error;
  double tolerance = 0;  ///< of the root of the sum of squares of the residuals, in units of the error
  optim::CurveVariables allowed;  ///< of the strip
  model::CellSize size;
  optim::MultiStartOptions starts = {};

  /// @throws InvalidInput for what leaves nothing to search
  OwnFit fit() const;

  app::Forecast forecast() const override;
  app::Found search(const app::RunOptions& options) const override;
  /// Of the model's state and of where the physics run ended, laid over that.
  std::shared_ptr<const app::Measure> measure(const app::Run& run, app::StateOf of, const model::State& state,
                                              const app::RunOptions& options) const override;
};

}  // namespace kinetix::python
