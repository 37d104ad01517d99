#include <ceres/ceres.h>

#include "optim/solvers/best_so_far.hpp"

namespace kinetix::optim {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class Cost final : public ceres::CostFunction {
 public:
  Cost(const LeastSquaresProblem& problem, BestSoFar& best) : best_(best), variables_(problem.variables()) {
    set_num_residuals(problem.residuals());
    mutable_parameter_block_sizes()->push_back(variables_);
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const bool wants_jacobian = jacobians && jacobians[0];
    const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(parameters[0], variables_);
    if (!best_.evaluate(x, r_, wants_jacobian ? &J_ : nullptr)) return false;
    Eigen::Map<Eigen::VectorXd>(residuals, r_.size()) = r_;
    if (wants_jacobian) Eigen::Map<RowMajor>(jacobians[0], J_.rows(), J_.cols()) = J_;
    return true;
  }

 private:
  BestSoFar& best_;
  int variables_;
  mutable Eigen::VectorXd r_;
  mutable Eigen::MatrixXd J_;
};

class StopOnRequest final : public ceres::IterationCallback {
 public:
  explicit StopOnRequest(const BestSoFar& best) : best_(best) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return best_.should_stop() ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  const BestSoFar& best_;
};

ceres::Solver::Options ceres_options(const SolverOptions& options) {
  ceres::Solver::Options out;
  out.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  out.initial_trust_region_radius = options.trust_radius;
  out.max_num_iterations = options.max_evaluations;
  out.function_tolerance = options.tolerance;
  out.gradient_tolerance = 1e-15;
  out.parameter_tolerance = 1e-13;
  out.num_threads = 1;
  out.logging_type = ceres::SILENT;
  return out;
}

SolveStatus status_of(const ceres::Solver::Summary& summary, const BestSoFar& best) {
  if (best.out_of_evaluations()) return SolveStatus::evaluation_limit;
  switch (summary.termination_type) {
    case ceres::CONVERGENCE:
      return SolveStatus::converged;
    case ceres::USER_SUCCESS:
      return SolveStatus::converged;
    case ceres::NO_CONVERGENCE:
      return SolveStatus::evaluation_limit;
    default:
      return SolveStatus::failed;
  }
}

/// Describes Ceres' reason to stop, which it reports only as a sentence about its own tolerances.
std::string words(const ceres::Solver::Summary& summary, const BestSoFar& best) {
  if (best.out_of_evaluations()) return "evaluation limit";
  const auto says = [&](const char* text) { return summary.message.find(text) != std::string::npos; };
  if (says("Function tolerance")) return "the error stopped improving";
  if (says("Gradient tolerance")) return "the gradient vanished";
  if (says("Parameter tolerance")) return "the variables stopped changing";
  if (says("trust region")) return "no step improved the error any more";
  return summary.message;
}

}  // namespace

SolveResult solve_with_ceres(const LeastSquaresProblem& problem, const Eigen::VectorXd& start,
                             const SolverOptions& options) {
  BestSoFar best(problem, start, options);
  Eigen::VectorXd x = start;
  ceres::Problem ceres_problem;
  ceres_problem.AddResidualBlock(new Cost(problem, best), nullptr, x.data());
  for (int k = 0; k < problem.variables(); ++k) {
    if (std::isfinite(problem.lower()[k]))
      ceres_problem.SetParameterLowerBound(x.data(), k, problem.lower()[k]);
    if (std::isfinite(problem.upper()[k]))
      ceres_problem.SetParameterUpperBound(x.data(), k, problem.upper()[k]);
  }
  StopOnRequest stop(best);
  ceres::Solver::Options ceres_settings = ceres_options(options);
  ceres_settings.callbacks.push_back(&stop);
  ceres::Solver::Summary summary;
  ceres::Solve(ceres_settings, &ceres_problem, &summary);
  return best.finish(status_of(summary, best), words(summary, best));
}

}  // namespace kinetix::optim
