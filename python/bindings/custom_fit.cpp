#include "python/bindings/custom_fit.hpp"

#include <random>

namespace kinetix::python {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Step, rad: the cube root of the rounding of a double, at which central differences are best.
constexpr double difference_step = 6e-6;
// Fraction of half the range of tilts: gentle bends, from which all others can be reached.
constexpr double gentle_bend = 0.15;

}  // namespace

CustomFit::CustomFit(const CustomError& error, optim::BendTies ties, int rows, double cell_mm,
                     optim::AngleRange theta)
    : error_(error), ties_(std::move(ties)), rows_(rows), cell_mm_(cell_mm) {
  lower_.resize(variables());
  upper_.resize(variables());
  for (int k = 0; k < ties_.variables(); ++k) {
    lower_[k] = ties_.range[k].lower;
    upper_[k] = ties_.range[k].upper;
  }
  lower_[ties_.variables()] = theta.lower;
  upper_[ties_.variables()] = theta.upper;
}

model::ExactDesign<double> CustomFit::design(const VectorXd& x) const {
  auto design = model::ExactDesign<double>::basic(ties_.columns(), rows_);
  for (int c = 0; c < ties_.columns(); ++c) design.beta[c] = ties_.sign[c] * x[ties_.variable[c]];
  design.theta = x[ties_.variables()];
  return design;
}

model::State CustomFit::state(const VectorXd& x) const {
  model::State lattice;
  fold(design(x), cell_mm_, lattice);
  return lattice;
}

bool CustomFit::error_at(const VectorXd& x, VectorXd& r) const {
  return !stop_.stop_requested() && error_.at(state(x), r);
}

bool CustomFit::evaluate(const VectorXd& x, VectorXd& r, MatrixXd* J) const {
  if (!x.allFinite() || !error_at(x, r)) return false;
  if (!J) return true;
  return error_.has_gradient() ? exact_jacobian(x, *J) : differences(x, *J);
}

bool CustomFit::exact_jacobian(const VectorXd& x, MatrixXd& J) const {
  model::State lattice;
  model::ExactJacobian derivatives;
  fold_with_jacobian(design(x), cell_mm_, lattice, derivatives);
  MatrixXd by_bodies;
  if (!error_.gradient_at(lattice, by_bodies)) return false;
  MatrixXd twists = MatrixXd::Zero(by_bodies.cols(), variables());
  const auto add = [&](int parameter, int variable, double sign) {
    for (int b = 0; b < derivatives.bodies(); ++b) {
      const model::Twist& twist = derivatives.twist(parameter, b);
      twists.col(variable).segment<3>(6 * b) += sign * twist.v;
      twists.col(variable).segment<3>(6 * b + 3) += sign * twist.omega;
    }
  };
  for (int c = 0; c < ties_.columns(); ++c) add(derivatives.beta(c), ties_.variable[c], ties_.sign[c]);
  add(derivatives.theta(), ties_.variables(), 1);
  J = by_bodies * twists;
  return J.allFinite();
}

bool CustomFit::differences(const VectorXd& x, MatrixXd& J) const {
  J.resize(residuals(), variables());
  VectorXd before, after;
  for (int k = 0; k < variables(); ++k) {
    VectorXd moved = x;
    moved[k] = x[k] + difference_step;
    const double to = moved[k];
    if (!error_at(moved, after)) return false;
    moved[k] = x[k] - difference_step;
    if (!error_at(moved, before)) return false;
    J.col(k) = (after - before) / (to - moved[k]);
  }
  return true;
}

VectorXd CustomFit::start(int k, std::uint64_t seed) const {
  const int bends = ties_.variables();
  const VectorXd middle = (lower_ + upper_) / 2, half = (upper_ - lower_) / 2;
  VectorXd x = VectorXd::Zero(variables());
  x[bends] = middle[bends];
  std::seed_seq words{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                      static_cast<std::uint32_t>(k)};
  std::mt19937_64 engine(words);
  const auto random = [&] { return 2 * static_cast<double>(engine() >> 11) * 0x1p-53 - 1; };
  if (k > 0) {
    const bool even = k <= 2;
    const double bend = even ? (k == 1 ? 1 : -1) * gentle_bend : random() * 2 * gentle_bend;
    const double turn = even ? 0 : random() * 2 * gentle_bend;
    for (int i = 0; i < bends; ++i)
      x[i] = half[i] * (bend + turn * (bends > 1 ? 2.0 * i / (bends - 1) - 1 : 0));
    if (!even) x[bends] += random() * half[bends] / 2;
  }
  return x.cwiseMax(lower_).cwiseMin(upper_);
}

}  // namespace kinetix::python
