#include "benchmarks/peers/differenced_problem.hpp"

namespace kinetix::bench {

using Eigen::VectorXd;

DifferencedProblem::DifferencedProblem(const optim::LeastSquaresProblem& problem, Differences differences,
                                       double step)
    : problem_(problem), differences_(differences), step_(step) {}

bool DifferencedProblem::evaluate(const VectorXd& x, VectorXd& r, Eigen::MatrixXd* J) const {
  if (!problem_.evaluate(x, r, nullptr)) return false;
  if (!J) return true;
  J->resize(residuals(), variables());
  VectorXd above(residuals()), below(residuals());
  for (int k = 0; k < variables(); ++k) {
    VectorXd plus = x, minus = x;
    plus[k] = std::min(x[k] + step_, upper()[k]);
    if (differences_ == Differences::central || plus[k] - x[k] < step_ / 2)
      minus[k] = std::max(x[k] - step_, lower()[k]);
    if (plus[k] == x[k])
      above = r;
    else if (!problem_.evaluate(plus, above, nullptr))
      return false;
    if (minus[k] == x[k])
      below = r;
    else if (!problem_.evaluate(minus, below, nullptr))
      return false;
    J->col(k) = (above - below) / (plus[k] - minus[k]);
  }
  return true;
}

}  // namespace kinetix::bench
