#include "optim/display/display_problem.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "model/linkage/hinge_mismatch.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// Times the limit of stretch. The penalty begins a little below it: what is left of an excess at the end
/// stays within.
constexpr double begins = 0.92;

double turn_in_plane(const model::Pose& pose) { return std::atan2(pose.R(1, 0), pose.R(0, 0)); }

model::CellReading rotation_reading(const model::Linkage& structure, const model::State& state,
                                    const model::LinkageCell& cell) {
  const std::size_t count = cell.bodies.size();
  const auto share = static_cast<double>(count);
  model::CellReading reading(count);
  for (std::size_t k = 0; k < count; ++k) {
    const int sense = structure.bodies[cell.bodies[k]].sense;
    reading.value += sense * turn_in_plane(state[cell.bodies[k]]) / share;
    reading.bodies(0, k) = sense / share;
  }
  return reading;
}

}  // namespace

std::string to_string(Channel channel) {
  switch (channel) {
    case Channel::area:
      return "area";
    case Channel::rotation:
      return "rotation";
    case Channel::aperture:
      break;
  }
  return "aperture";
}

double channel_value(Channel channel, const model::Linkage& structure, const model::State& state,
                     const model::LinkageCell& cell) {
  if (channel == Channel::aperture) return aperture(opening(structure, state, cell));
  return channel_reading(channel, structure, state, cell).value;
}

std::vector<double> channel_values(Channel channel, const model::Linkage& structure,
                                   const model::State& state) {
  std::vector<double> values;
  for (const model::LinkageCell& cell : structure.cells)
    values.push_back(channel_value(channel, structure, state, cell));
  return values;
}

model::CellReading channel_reading(Channel channel, const model::Linkage& structure,
                                   const model::State& state, const model::LinkageCell& cell) {
  switch (channel) {
    case Channel::area:
      return area_reading(opening(structure, state, cell));
    case Channel::rotation:
      return rotation_reading(structure, state, cell);
    case Channel::aperture:
      break;
  }
  return soft_aperture(opening(structure, state, cell));
}

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
  Slopes slopes{VectorXd::Zero(6 * static_cast<Eigen::Index>(equilibrium_.state().size())),
                VectorXd::Zero(static_cast<Eigen::Index>(equilibrium_.panel().hinges.size()))};
  f = add_picture(slopes) + add_stretch(slopes);
  if (!gradient) return std::isfinite(f);
  auto by = equilibrium_.slopes(slopes.state);
  if (!by) return false;
  by->t += slopes.t;
  *gradient = variables_.gather(*by);
  return std::isfinite(f) && gradient->allFinite();
}

double DisplayProblem::add_picture(Slopes& slopes) const {
  const model::Linkage panel = equilibrium_.panel();
  std::vector<model::CellReading> readings;
  std::vector<double> values;
  for (const model::LinkageCell& cell : panel.cells) {
    readings.push_back(channel_reading(channel_, panel, equilibrium_.state(), cell));
    values.push_back(readings.back().value);
  }
  const WeighedReadings weighed = cost_(values);
  for (std::size_t k = 0; k < readings.size(); ++k)
    for (std::size_t m = 0; m < panel.cells[k].bodies.size(); ++m) {
      const Eigen::Index body = 6 * panel.cells[k].bodies[m];
      slopes.state.segment<3>(body + 2) += weighed.slope[k] * readings[k].bodies.col(m);
      slopes.t[panel.cells[k].hinges[m]] += weighed.slope[k] * readings[k].t[m];
    }
  return weighed.cost;
}

double DisplayProblem::add_stretch(Slopes& slopes) const {
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
    slopes.state.segment<3>(6 * hinge.lower) += lower_arm.cross(pull);
    slopes.state.segment<3>(6 * hinge.lower + 3) += pull;
    slopes.state.segment<3>(6 * hinge.upper) -= upper_arm.cross(pull);
    slopes.state.segment<3>(6 * hinge.upper + 3) -= pull;
    slopes.t[h] += pull.dot(lower.R * hinge.edge - upper.R * hinge.edge);
  }
  return cost;
}

}  // namespace kinetix::optim
