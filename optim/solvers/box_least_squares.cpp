#include "optim/solvers/box_least_squares.hpp"

#include <algorithm>
#include <cmath>

#include "model/base/decompositions.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::optim {
namespace {

using Eigen::SparseMatrix;
using Eigen::VectorXd;

constexpr double over_relaxation = 1.6;  // 1.5 to 1.8 is usual (Boyd et al. 2011, section 3.4.3)
constexpr double first_penalty = 1;  // ratio to the costs if both have rows of about one size; adapted later
constexpr int poll_interval = 25;    // iterations between checks of the penalty: a factorisation is expensive
constexpr double out_of_balance = 5;  // ratio of the two misses that triggers another penalty

bool is_finite(const SparseMatrix<double>& matrix) {
  return std::isfinite(matrix.squaredNorm());  // NaN and infinity survive in a sum of squares
}

void validate(const BoxLeastSquares& p) {
  const bool fits = p.A.cols() == p.C.cols() && p.A.cols() == p.from.size() && p.A.rows() == p.b.size() &&
                    p.C.rows() == p.lower.size() && p.C.rows() == p.upper.size();
  if (!fits) throw InvalidInput("box least squares: sizes do not fit");
  const bool finite = p.b.allFinite() && p.from.allFinite() && is_finite(p.A) && is_finite(p.C);
  if (!finite || !(p.lower.array() <= p.upper.array()).all())
    throw InvalidInput("box least squares: numbers must be finite, and lower bounds not above upper ones");
  require("damping", p.damping, p.damping > 0, "above 0");
}

class Solver {
 public:
  Solver(const BoxLeastSquares& p, const BoxLeastSquaresMemory* memory)
      : p_(p), Ct_(p.C.transpose()), squares_(p.A.transpose() * p.A) {
    SparseMatrix<double> identity(p.A.cols(), p.A.cols());
    identity.setIdentity();
    squares_ += p.damping * identity;
    bounds_ = Ct_ * p.C;
    pull_ = p.A.transpose() * p.b + p.damping * p.from;
    const bool goes_on = memory && memory->dual.size() == p.C.rows();
    z_ = (goes_on ? memory->within : VectorXd(p.C * p.from)).cwiseMax(p.lower).cwiseMin(p.upper);
    dual_ = goes_on ? memory->dual : VectorXd(VectorXd::Zero(p.C.rows()));
    factor_.analyze(squares_ + bounds_);
    set_penalty(goes_on ? memory->penalty : first_penalty);
  }

  BoxLeastSquaresResult run(const BoxLeastSquaresOptions& options) {
    BoxLeastSquaresResult out;
    while (!out.converged && out.iterations < options.most_iterations) {
      ++out.iterations;
      const double moved = step();
      out.excess = missed();
      out.converged = out.excess <= options.settled && moved <= options.settled;
      if (out.iterations % poll_interval == 0) balance(moved);
    }
    out.u = u_;
    out.memory = {z_, dual_, penalty_};
    return out;
  }

 private:
  /// Performs one iteration. @return largest change of C u within its bounds
  double step() {
    u_ = factor_.solve(pull_ + penalty_ * (Ct_ * (z_ - dual_)));
    value_ = p_.C * u_;
    const VectorXd relaxed = over_relaxation * value_ + (1 - over_relaxation) * z_ + dual_;
    const VectorXd next = relaxed.cwiseMax(p_.lower).cwiseMin(p_.upper);
    const double moved = next.size() == 0 ? 0 : (next - z_).cwiseAbs().maxCoeff();
    dual_ = relaxed - next;
    z_ = next;
    return moved;
  }

  double missed() const { return value_.size() == 0 ? 0 : (value_ - z_).cwiseAbs().maxCoeff(); }

  void balance(double moved) {
    const double ratio = missed() / std::max(moved, 1e-300);
    if (ratio < out_of_balance && ratio > 1 / out_of_balance) return;
    const double factor = std::clamp(std::sqrt(ratio), 0.1, 10.0);
    dual_ /= factor;
    set_penalty(std::clamp(penalty_ * factor, 1e-5, 1e5));
  }

  void set_penalty(double penalty) {
    penalty_ = penalty;
    factor_.factorize(squares_ + penalty_ * bounds_);
  }

  const BoxLeastSquares& p_;
  SparseMatrix<double> Ct_, squares_, bounds_;
  SparseFactor factor_;
  VectorXd pull_, u_, value_, z_, dual_;
  double penalty_ = first_penalty;
};

}  // namespace

BoxLeastSquaresResult solve_box_least_squares(const BoxLeastSquares& problem,
                                              const BoxLeastSquaresOptions& options,
                                              const BoxLeastSquaresMemory* memory) {
  validate(problem);
  return Solver(problem, memory).run(options);
}

}  // namespace kinetix::optim
