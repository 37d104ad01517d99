#include "optim/display/display_variables.hpp"

#include <algorithm>

namespace kinetix::optim {

using Eigen::VectorXd;

VectorXd DisplayVariables::joined(const VectorXd& of_ties, double of_compression,
                                  const VectorXd& of_offsets) const {
  const Eigen::Index middle = compression ? 1 : 0, last = offset > 0 ? of_offsets.size() : 0;
  VectorXd x(ties.variables + middle + last);
  x.head(ties.variables) = of_ties;
  if (compression) x[ties.variables] = of_compression;
  x.tail(last) = of_offsets.head(last);
  return x;
}

VectorXd DisplayVariables::bounds_of_ties(int side) const {
  const double turned = 1 - t[1 - side];
  VectorXd out = VectorXd::Constant(ties.variables, t[side]);
  for (std::size_t h = 0; h < ties.variable.size(); ++h) {
    if (ties.variable[h] == HingeTies::centred || !ties.reversed[h]) continue;
    double& of_tie = out[ties.variable[h]];
    of_tie = side == 0 ? std::max(of_tie, turned) : std::min(of_tie, turned);
  }
  return out;
}

VectorXd DisplayVariables::bounds(int side) const {
  const double most = side == 0 ? -offset : offset;
  const VectorXd widest = joined(bounds_of_ties(side), compression ? (*compression)[side] : 0,
                                 VectorXd::Constant(static_cast<Eigen::Index>(ties.variable.size()), most));
  if (middle.size() == 0) return widest;
  return side == 0 ? VectorXd(widest.array().max(middle.array() - reach))
                   : VectorXd(widest.array().min(middle.array() + reach));
}

VectorXd DisplayVariables::nearest(const VectorXd& of_hinges, double pressed, const VectorXd& off) const {
  const VectorXd zero = VectorXd::Zero(static_cast<Eigen::Index>(ties.variable.size()));
  const VectorXd x = joined(ties.nearest(of_hinges), pressed, off.size() > 0 ? off : zero);
  return x.cwiseMax(lower()).cwiseMin(upper());
}

VectorXd DisplayVariables::offset_of(const VectorXd& x) const {
  if (!(offset > 0)) return {};
  return x.tail(static_cast<Eigen::Index>(ties.variable.size()));
}

std::optional<double> DisplayVariables::compression_of(const VectorXd& x) const {
  if (!compression) return std::nullopt;
  return x[ties.variables];
}

bool DisplayVariables::settle(PanelEquilibrium& equilibrium, const VectorXd& x) const {
  if (compression) equilibrium.press(*compression_of(x));
  return equilibrium.settle(t_of(x), offset_of(x));
}

VectorXd DisplayVariables::gather(const PanelEquilibrium::Gradient& gradient) const {
  return joined(ties.gather(gradient.t), gradient.compression, gradient.offset);
}

}  // namespace kinetix::optim
