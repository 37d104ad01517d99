#pragma once

#include <memory>

#include "app/run/run.hpp"
#include "app/run/scene.hpp"
#include "optim/solvers/multi_start.hpp"
#include "python/bindings/own_fit.hpp"

namespace kinetix::python {

/// A goal of one's own: how large the strip is, what the search may vary, and when the goal is met.
struct OwnGoal {
  std::string name = "own_goal";
  std::shared_ptr<const OwnError> error;
  double tolerance = 0;  ///< of the root of the sum of squares of the residuals, in units of the error
  int columns = 20, rows = 1;
  model::CellSize size;
  optim::AngleRange beta, theta;  ///< rad
  optim::Per per = optim::Per::column;
  optim::Symmetry symmetry = optim::Symmetry::none;
  optim::MultiStartOptions search = {};

  /// @throws InvalidInput for what leaves nothing to search
  OwnFit fit() const;
};

/// What its search found.
class OwnOutcome final : public app::GoalOutcome {
 public:
  std::string name;
  optim::MultiStartResult search;
  optim::SolverName solver = optim::SolverName::ceres;
  double tolerance = 0;  ///< of the norm of the residuals, in units of the error

  void add_sections(const app::Run& run, nlohmann::ordered_json& result) const override;
  void add_metrics(const app::Run& run, nlohmann::ordered_json& metrics) const override;
  std::vector<app::SummaryLine> summary_lines(const app::Run& run) const override;
};

class OwnMeasure final : public app::Measure {
 public:
  Eigen::VectorXd residuals;  ///< of the state, in units of the error
};

/// The goal for the pipeline: search, closed form, physics run.
std::unique_ptr<app::Scene> make_scene(OwnGoal goal);

}  // namespace kinetix::python
