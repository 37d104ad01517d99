#pragma once

#include <cmath>
#include <limits>

#include "optim/solver.hpp"

namespace kinetix {

/// Counts evaluations and keeps the best feasible one.
class BestSoFar {
 public:
  BestSoFar(const LeastSquaresProblem& problem, const Eigen::VectorXd& start, const SolverOptions& options)
      : problem_(problem), options_(options) {
    result_.x = start;
    result_.residual_norm = std::numeric_limits<double>::infinity();
  }

  /// Evaluates the problem and notes the point. @return false where it cannot be evaluated
  bool evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) {
    ++result_.evaluations;
    if (!problem_.evaluate(x, r, J)) return false;
    const double norm = r.norm();
    if (norm < result_.residual_norm && is_feasible(x)) {
      result_.x = x;
      result_.residual_norm = norm;
      result_.history.emplace_back(result_.evaluations, norm);
    }
    return true;
  }

  bool target_reached() const { return options_.target > 0 && result_.residual_norm <= options_.target; }
  bool out_of_evaluations() const { return result_.evaluations >= options_.max_evaluations; }
  bool should_stop() const { return target_reached() || out_of_evaluations(); }

  SolveResult finish(SolveStatus status, std::string why) {
    result_.status = target_reached() ? SolveStatus::target_reached : status;
    result_.why = target_reached() ? "the residual reached the value asked for" : std::move(why);
    if (!std::isfinite(result_.residual_norm)) result_.status = SolveStatus::cannot_evaluate;
    return std::move(result_);
  }

 private:
  bool is_feasible(const Eigen::VectorXd& x) const {
    return (x.array() >= problem_.lower().array()).all() && (x.array() <= problem_.upper().array()).all();
  }

  const LeastSquaresProblem& problem_;
  const SolverOptions& options_;
  SolveResult result_;
};

SolveResult solve_with_ceres(const LeastSquaresProblem& problem, const Eigen::VectorXd& start,
                             const SolverOptions& options);
SolveResult solve_with_nlopt(const LeastSquaresProblem& problem, const Eigen::VectorXd& start,
                             const SolverOptions& options);

}  // namespace kinetix
