#include "optim/display/display_variables.hpp"

namespace kinetix::optim {
namespace {

using Eigen::VectorXd;

VectorXd joined(const VectorXd& of_ties, const std::optional<double>& last) {
  if (!last) return of_ties;
  VectorXd x(of_ties.size() + 1);
  x << of_ties, *last;
  return x;
}

}  // namespace

VectorXd DisplayVariables::bounds(int side) const {
  return joined(VectorXd::Constant(ties.variables, t[side]),
                compression ? std::optional((*compression)[side]) : std::nullopt);
}

VectorXd DisplayVariables::nearest(const VectorXd& of_hinges, double pressed) const {
  const VectorXd x = joined(ties.nearest(of_hinges), compression ? std::optional(pressed) : std::nullopt);
  return x.cwiseMax(lower()).cwiseMin(upper());
}

std::optional<double> DisplayVariables::compression_of(const VectorXd& x) const {
  if (!compression) return std::nullopt;
  return x[ties.variables];
}

bool DisplayVariables::settle(PanelEquilibrium& equilibrium, const VectorXd& x) const {
  if (compression) equilibrium.press(*compression_of(x));
  return equilibrium.settle(t_of(x));
}

VectorXd DisplayVariables::gather(const PanelEquilibrium::Slopes& slopes) const {
  return joined(ties.gather(slopes.t), compression ? std::optional(slopes.compression) : std::nullopt);
}

}  // namespace kinetix::optim
