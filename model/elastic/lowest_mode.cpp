#include "model/elastic/lowest_mode.hpp"

#include <Spectra/SymEigsShiftSolver.h>
#include <cmath>
#include <limits>

#include "model/base/decompositions.hpp"

namespace kinetix::model {
namespace {

constexpr int dense_below = 60;       // unknowns: dense is faster below; the iteration keeps 20 vectors
constexpr double first_shift = 1e-7;  // k_point edge^2: below the turn stiffness of a usual hinge, 1e-6

/// Operator for Spectra: maps x to (H + shift)^-1 x. The tangent is already factorised with the shift.
class ShiftedInverse {
 public:
  using Scalar = double;

  explicit ShiftedInverse(const TangentStiffness& tangent) : tangent_(tangent) {}
  Eigen::Index rows() const { return tangent_.size(); }
  Eigen::Index cols() const { return tangent_.size(); }
  void set_shift(double) const {}
  void perform_op(const double* in, double* out) const {
    Eigen::Map<Eigen::VectorXd>(out, rows()) = tangent_.solve(Eigen::Map<const Eigen::VectorXd>(in, rows()));
  }

 private:
  const TangentStiffness& tangent_;
};

void scale(LowestMode& s) { s.direction /= s.direction.lpNorm<Eigen::Infinity>(); }

LowestMode dense(const TangentStiffness& tangent) {
  const Eigen::MatrixXd full = Eigen::MatrixXd(tangent.matrix()).selfadjointView<Eigen::Lower>();
  const Eigenvectors modes = symmetric_eigenvectors(full);
  LowestMode s;
  s.value = modes.values[0];
  s.next = full.rows() > 1 ? modes.values[1] : std::numeric_limits<double>::quiet_NaN();
  s.direction = modes.vectors.col(0);
  s.converged = modes.converged;
  scale(s);
  return s;
}

/// Factorises the tangent with the first shift that makes it positive definite. Twice its norm is always
/// enough.
/// @return the shift; NaN if the tangent is not finite
double factorise_shifted(TangentStiffness& tangent) {
  double shift = first_shift;
  while (!tangent.factorise(shift)) {
    if (!(shift < 4 * tangent.matrix().norm())) return std::numeric_limits<double>::quiet_NaN();
    shift *= 4;
  }
  return shift;
}

}  // namespace

LowestMode lowest_mode(TangentStiffness& tangent) {
  if (tangent.size() < dense_below) {
    tangent.factorise(1);
    return dense(tangent);
  }
  const double shift = factorise_shifted(tangent);
  if (!std::isfinite(shift)) return {};
  ShiftedInverse inverse(tangent);
  Spectra::SymEigsShiftSolver<ShiftedInverse> solver(inverse, 2, 20, -shift);
  solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, 300, 1e-9, Spectra::SortRule::SmallestAlge);
  LowestMode s;
  s.converged = solver.info() == Spectra::CompInfo::Successful;
  if (!s.converged) return s;
  s.value = solver.eigenvalues()[0];
  s.next = solver.eigenvalues()[1];
  s.direction = solver.eigenvectors().col(0);
  scale(s);
  return s;
}

}  // namespace kinetix::model
