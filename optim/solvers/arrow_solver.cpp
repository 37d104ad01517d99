#include "optim/solvers/arrow_solver.hpp"

#include <ceres/ceres.h>
#include <cmath>
#include <limits>
#include <new>
#include <set>

namespace kinetix::optim {
namespace {

using Eigen::VectorXd;
/// Most searches, each with other variables held on their bounds: variables that change after that are in a
/// cycle.
constexpr int max_dampings = 8;

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

double squared_norm(const std::vector<ResidualBlock>& blocks) {
  double sum = 0;
  for (const ResidualBlock& block : blocks) sum += block.r.squaredNorm();
  return sum;
}

/// Returns the index in x of each part's first variable.
std::vector<int> offsets(const ArrowProblem& problem) {
  std::vector<int> out;
  int at = problem.shared();
  for (const int size : problem.parts()) {
    out.push_back(at);
    at += size;
  }
  return out;
}

/// Evaluates all blocks together at each point of Ceres, and keeps the best feasible point.
class Evaluation final : public ceres::EvaluationCallback {
 public:
  Evaluation(const ArrowProblem& problem, VectorXd& x, const SolverOptions& options)
      : problem_(problem), x_(x), options_(options) {
    result_.x = x;
    result_.residual_norm = std::numeric_limits<double>::infinity();
  }

  void PrepareForEvaluation(bool with_derivatives, bool new_point) override {
    if (!new_point && (!with_derivatives || has_derivatives_)) return;
    has_derivatives_ = with_derivatives;
    if (new_point) ++result_.evaluations;
    try {
      valid_ = problem_.evaluate(x_, with_derivatives, blocks_);
    } catch (const std::bad_alloc&) {
      out_of_memory_ = true;
      valid_ = false;
    } catch (const std::exception& error) {
      thrown_ = error.what();
      valid_ = false;
    }
    const double norm = valid_ ? std::sqrt(squared_norm(blocks_)) : std::numeric_limits<double>::quiet_NaN();
    valid_ = std::isfinite(norm);
    if (valid_ && norm < result_.residual_norm && is_feasible()) {
      result_.x = x_;
      result_.residual_norm = norm;
      result_.history.emplace_back(result_.evaluations, norm);
    }
    if (options_.on_progress) options_.on_progress(result_.evaluations, result_.residual_norm);
  }

  bool valid() const { return valid_; }
  const ResidualBlock& block(std::size_t k) const { return blocks_[k]; }
  int evaluations() const { return result_.evaluations; }

  SolveResult finish(SolveStatus status, std::string why) {
    if (out_of_memory_) throw std::bad_alloc();
    result_.status = status;
    result_.why = std::move(why);
    if (!std::isfinite(result_.residual_norm)) {
      result_.status = SolveStatus::cannot_evaluate;
      result_.why = "the problem cannot be evaluated at any point tried";
    }
    if (!thrown_.empty()) {
      result_.status = SolveStatus::failed;
      result_.why = thrown_;
    }
    return std::move(result_);
  }

 private:
  bool is_feasible() const {
    return (x_.array() >= problem_.lower().array()).all() && (x_.array() <= problem_.upper().array()).all();
  }

  const ArrowProblem& problem_;
  const VectorXd& x_;
  const SolverOptions& options_;
  std::vector<ResidualBlock> blocks_;
  bool valid_ = false, has_derivatives_ = false, out_of_memory_ = false;
  SolveResult result_;
  std::string thrown_;
};

class BlockCost final : public ceres::CostFunction {
 public:
  BlockCost(const Evaluation& evaluation, std::size_t block, int residuals, int shared, int own)
      : evaluation_(evaluation), block_(block) {
    set_num_residuals(residuals);
    if (own > 0) mutable_parameter_block_sizes()->push_back(own);
    mutable_parameter_block_sizes()->push_back(shared);
    has_local_ = own > 0;
  }

  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    if (!evaluation_.valid()) return false;
    const ResidualBlock& block = evaluation_.block(block_);
    Eigen::Map<VectorXd>(residuals, block.r.size()) = block.r;
    if (!jacobians) return true;
    if (has_local_) fill(block.by_local, jacobians[0]);
    fill(block.by_shared, jacobians[has_local_ ? 1 : 0]);
    return block.by_shared.allFinite() && block.by_local.allFinite();
  }

 private:
  static void fill(const Eigen::MatrixXd& J, double* out) {
    if (out) Eigen::Map<RowMajor>(out, J.rows(), J.cols()) = J;
  }

  const Evaluation& evaluation_;
  std::size_t block_;
  bool has_local_ = false;
};

class StopAtLimit final : public ceres::IterationCallback {
 public:
  StopAtLimit(const Evaluation& evaluation, const SolverOptions& options)
      : evaluation_(evaluation), options_(options) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return reached() || options_.stop.stop_requested() ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
                                                       : ceres::SOLVER_CONTINUE;
  }
  bool reached() const { return evaluation_.evaluations() >= options_.max_evaluations; }

 private:
  const Evaluation& evaluation_;
  const SolverOptions& options_;
};

/// Variables from..from + size - 1 of x, one parameter block of Ceres.
struct Block {
  double* values;
  int from, size;
};

void bound(ceres::Problem& ceres_problem, const ArrowProblem& problem, const Block& block) {
  for (int k = 0; k < block.size; ++k) {
    const double low = problem.lower()[block.from + k], high = problem.upper()[block.from + k];
    if (std::isfinite(low)) ceres_problem.SetParameterLowerBound(block.values, k, low);
    if (std::isfinite(high)) ceres_problem.SetParameterUpperBound(block.values, k, high);
  }
}

void hold(ceres::Problem& ceres_problem, const Block& block, const std::set<int>& held) {
  std::vector<int> mine;
  for (int k = 0; k < block.size; ++k)
    if (held.count(block.from + k)) mine.push_back(k);
  if (static_cast<int>(mine.size()) == block.size)
    ceres_problem.SetParameterBlockConstant(block.values);
  else if (!mine.empty())
    ceres_problem.SetManifold(block.values, new ceres::SubsetManifold(block.size, mine));
}

/// Adds the parameter blocks. Parts are group 0, eliminated first.
void add_blocks(ceres::Problem& ceres_problem, const ArrowProblem& problem, const Evaluation& evaluation,
                VectorXd& x, const std::set<int>& held, ceres::ParameterBlockOrdering& order) {
  const std::vector<int> from = offsets(problem);
  const Block shared = {x.data(), 0, problem.shared()};
  for (std::size_t k = 0; k <= from.size(); ++k) {
    const bool is_part = k < from.size();
    const Block own = is_part ? Block{x.data() + from[k], from[k], problem.parts()[k]} : Block{nullptr, 0, 0};
    if (problem.residuals()[k] == 0) continue;
    std::vector<double*> values;
    if (own.size > 0) values.push_back(own.values);
    values.push_back(shared.values);
    ceres_problem.AddResidualBlock(
        new BlockCost(evaluation, k, problem.residuals()[k], shared.size, own.size), nullptr, values);
    if (own.size == 0) continue;
    bound(ceres_problem, problem, own);
    hold(ceres_problem, own, held);
    order.AddElementToGroup(own.values, 0);
  }
  bound(ceres_problem, problem, shared);
  hold(ceres_problem, shared, held);
  order.AddElementToGroup(shared.values, 1);
}

ceres::Solver::Options settings(const SolverOptions& options) {
  ceres::Solver::Options out;
  out.linear_solver_type = ceres::DENSE_SCHUR;
  out.initial_trust_region_radius = 1e6;
  out.max_num_iterations = options.max_evaluations;
  out.function_tolerance = options.tolerance;
  out.gradient_tolerance = 1e-14;
  out.parameter_tolerance = 1e-12;
  out.num_threads = 1;
  out.logging_type = ceres::SILENT;
  return out;
}

/// Returns the variables on a bound beyond which the cost falls.
std::set<int> pressed_on_bounds(const ArrowProblem& problem, const VectorXd& x) {
  std::vector<ResidualBlock> blocks;
  std::set<int> out;
  if (!problem.evaluate(x, true, blocks)) return out;
  const StackedResiduals all = stacked(problem, blocks);
  const VectorXd gradient = all.J.transpose() * all.r;
  for (int k = 0; k < x.size(); ++k)
    if ((x[k] >= problem.upper()[k] && gradient[k] < 0) || (x[k] <= problem.lower()[k] && gradient[k] > 0))
      out.insert(k);
  return out;
}

SolveResult solve_holding(const ArrowProblem& problem, VectorXd x, const SolverOptions& options,
                          const std::set<int>& held) {
  Evaluation evaluation(problem, x, options);
  ceres::Problem::Options problem_options;
  problem_options.evaluation_callback = &evaluation;
  ceres::Problem ceres_problem(problem_options);
  ceres::Solver::Options ceres_settings = settings(options);
  ceres_settings.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  add_blocks(ceres_problem, problem, evaluation, x, held, *ceres_settings.linear_solver_ordering);
  StopAtLimit stop(evaluation, options);
  ceres_settings.callbacks.push_back(&stop);
  ceres::Solver::Summary summary;
  ceres::Solve(ceres_settings, &ceres_problem, &summary);
  if (options.stop.stop_requested()) return evaluation.finish(SolveStatus::stopped, "stopped");
  if (stop.reached() || summary.termination_type == ceres::NO_CONVERGENCE)
    return evaluation.finish(SolveStatus::evaluation_limit, "evaluation limit");
  const bool converged = summary.termination_type == ceres::CONVERGENCE;
  return evaluation.finish(converged ? SolveStatus::converged : SolveStatus::failed, summary.message);
}

/// Joins the results of two consecutive searches.
SolveResult joined(SolveResult first, SolveResult second) {
  for (const auto& [evaluations, norm] : second.history)
    if (norm < first.residual_norm) first.history.emplace_back(first.evaluations + evaluations, norm);
  first.evaluations += second.evaluations;
  first.status = second.status;
  first.why = std::move(second.why);
  if (second.residual_norm < first.residual_norm) {
    first.x = std::move(second.x);
    first.residual_norm = second.residual_norm;
  }
  return first;
}

}  // namespace

StackedResiduals stacked(const ArrowProblem& problem, const std::vector<ResidualBlock>& blocks) {
  Eigen::Index rows = 0, row = 0;
  for (const ResidualBlock& block : blocks) rows += block.r.size();
  StackedResiduals out{VectorXd(rows), Eigen::MatrixXd::Zero(rows, problem.lower().size())};
  const std::vector<int> from = offsets(problem);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const ResidualBlock& block = blocks[k];
    out.r.segment(row, block.r.size()) = block.r;
    out.J.block(row, 0, block.r.size(), problem.shared()) = block.by_shared;
    if (k < from.size()) out.J.block(row, from[k], block.r.size(), problem.parts()[k]) = block.by_local;
    row += block.r.size();
  }
  return out;
}

SolveResult solve(const ArrowProblem& problem, const VectorXd& start, const SolverOptions& options) {
  options.validate();
  SolveResult result =
      solve_holding(problem, start.cwiseMax(problem.lower()).cwiseMin(problem.upper()), options, {});
  std::set<int> held;
  for (int round = 0; round < max_dampings && std::isfinite(result.residual_norm); ++round) {
    if (options.stop.stop_requested()) break;
    std::set<int> pressed = pressed_on_bounds(problem, result.x);
    if (pressed == held) break;
    held = std::move(pressed);
    SolverOptions rest = options;
    rest.max_evaluations -= result.evaluations;
    if (rest.max_evaluations < 1) break;
    result = joined(std::move(result), solve_holding(problem, result.x, rest, held));
  }
  return result;
}

}  // namespace kinetix::optim
