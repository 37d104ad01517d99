#include "optim/display/display_problem.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "model/linkage/hinge_mismatch.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// Times the limit of stretch. The penalty begins a little below the limit, so that the excess left at the
/// end is within it.
constexpr double begins = 0.92;

}  // namespace

DisplayProblem::DisplayProblem(PanelEquilibrium& equilibrium, const DisplayVariables& variables,
                               Channel channel, Cost cost, double stretch, double weight, Settling settling)
    : equilibrium_(equilibrium),
      variables_(variables),
      channel_(channel),
      cost_(std::move(cost)),
      stretch_(stretch),
      weight_(weight),
      settling_(settling),
      lower_(variables.lower()),
      upper_(variables.upper()) {}

bool DisplayProblem::evaluate(const VectorXd& x, double& f, VectorXd* gradient) {
  if (settling_ == Settling::from_flat) equilibrium_.forget();
  if (!variables_.settle(equilibrium_, x) || !weigh(f, gradient)) return false;
  if (f < least_) {
    least_ = f;
    stretch_of_best_ = hinge_gaps(equilibrium_.panel(), equilibrium_.state()).max;
    equilibrium_.keep();
  }
  return true;
}

bool DisplayProblem::weigh(double& f, VectorXd* gradient) {
  model::PanelGradient panel(equilibrium_.panel());
  f = add_picture(panel) + add_stretch(panel);
  if (!gradient) return std::isfinite(f);
  auto by = equilibrium_.gradient(panel.state);
  if (!by) return false;
  by->t += panel.t;
  by->offset += panel.offset;
  *gradient = variables_.gather(*by);
  return std::isfinite(f) && gradient->allFinite();
}

double DisplayProblem::add_picture(model::PanelGradient& gradient) const {
  const model::Linkage panel = equilibrium_.panel();
  const SmoothChannel readings(channel_, panel, equilibrium_.state());
  const WeighedReadings weighed = cost_(readings.values());
  readings.add_gradient(weighed.slope, gradient);
  return weighed.cost;
}

double DisplayProblem::add_stretch(model::PanelGradient& gradient) const {
  const model::Linkage panel = equilibrium_.panel();
  double cost = 0;
  for (std::size_t h = 0; h < panel.hinges.size(); ++h) {
    const model::RestHinge& hinge = panel.hinges[h];
    const model::Pose &lower = equilibrium_.state()[hinge.lower], &upper = equilibrium_.state()[hinge.upper];
    const auto [gap, lower_arm, upper_arm] = point_mismatch(hinge, lower, upper, panel.size.edge_mm);
    const double excess = gap.norm() / stretch_ - begins;
    if (!(excess > 0)) continue;
    cost += weight_ * excess * excess;
    const Vector3d pull = 2 * weight_ * excess / stretch_ * gap.normalized();
    gradient.state.segment<3>(6 * hinge.lower) += lower_arm.cross(pull);
    gradient.state.segment<3>(6 * hinge.lower + 3) += pull;
    gradient.state.segment<3>(6 * hinge.upper) -= upper_arm.cross(pull);
    gradient.state.segment<3>(6 * hinge.upper + 3) -= pull;
    gradient.t[h] += pull.dot(lower.R * hinge.edge - upper.R * hinge.edge);
    gradient.offset[h] += pull.dot(lower.R * hinge.across - upper.R * hinge.across);
  }
  return cost;
}

}  // namespace kinetix::optim
