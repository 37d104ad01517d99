#pragma once

#include <cmath>
#include <exception>
#include <limits>
#include <new>

#include "optim/solvers/solver.hpp"

namespace kinetix::optim {

/// Counts evaluations and keeps the best feasible one. Catches all exceptions of the problem, so that none
/// reaches a solver.
class BestSoFar {
 public:
  BestSoFar(const LeastSquaresProblem& problem, const Eigen::VectorXd& start, const SolverOptions& options)
      : problem_(problem), options_(options) {
    result_.x = start;
    result_.residual_norm = std::numeric_limits<double>::infinity();
  }

  /// Evaluates the problem and records the point. @return false if it cannot be evaluated
  bool evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) {
    ++result_.evaluations;
    if (!evaluate_problem(x, r, J)) return false;
    const double norm = r.norm();
    if (!std::isfinite(norm) || (J && !J->allFinite())) return false;
    if (norm < result_.residual_norm && is_feasible(x)) {
      result_.x = x;
      result_.residual_norm = norm;
      result_.history.emplace_back(result_.evaluations, norm);
    }
    if (options_.on_progress) options_.on_progress(result_.evaluations, result_.residual_norm);
    return true;
  }

  bool target_reached() const { return options_.target > 0 && result_.residual_norm <= options_.target; }
  bool out_of_evaluations() const { return result_.evaluations >= options_.max_evaluations; }
  bool has_stop_request() const { return options_.stop.stop_requested(); }
  bool should_stop() const { return target_reached() || out_of_evaluations() || has_stop_request(); }

  /// Returns the result of the search.
  /// @param status, why as the solver reports them. A stop, the target, an exception, and a search without
  /// any value override them.
  /// @throws std::bad_alloc if the problem did: the rest of the search is then meaningless
  SolveResult finish(SolveStatus status, std::string why) {
    if (out_of_memory_) throw std::bad_alloc();
    result_.status = status;
    result_.why = std::move(why);
    if (has_stop_request()) {
      result_.status = SolveStatus::stopped;
      result_.why = "stopped";
    }
    if (!std::isfinite(result_.residual_norm) && result_.evaluations > 0) {
      result_.status = SolveStatus::cannot_evaluate;
      result_.why = "the problem cannot be evaluated at any point tried";
    }
    if (!thrown_.empty()) {
      result_.status = SolveStatus::failed;
      result_.why = thrown_;
    }
    if (target_reached()) {
      result_.status = SolveStatus::target_reached;
      result_.why = "the residual reached the requested value";
    }
    return std::move(result_);
  }

 private:
  bool evaluate_problem(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) {
    try {
      return problem_.evaluate(x, r, J);
    } catch (const std::bad_alloc&) {
      out_of_memory_ = true;
    } catch (const std::exception& error) {
      thrown_ = error.what();
    } catch (...) {
      thrown_ = "an unknown exception";
    }
    return false;
  }

  bool is_feasible(const Eigen::VectorXd& x) const {
    return (x.array() >= problem_.lower().array()).all() && (x.array() <= problem_.upper().array()).all();
  }

  const LeastSquaresProblem& problem_;
  const SolverOptions& options_;
  SolveResult result_;
  bool out_of_memory_ = false;  ///< whether the problem ran out of memory at any point
  std::string thrown_;          ///< last exception of the problem; empty for none
};

SolveResult solve_with_ceres(const LeastSquaresProblem& problem, const Eigen::VectorXd& start,
                             const SolverOptions& options);
SolveResult solve_with_nlopt(const LeastSquaresProblem& problem, const Eigen::VectorXd& start,
                             const SolverOptions& options);

}  // namespace kinetix::optim
