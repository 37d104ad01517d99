#include "optim/display_problem.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace kinetix {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// The penalty begins a little below the limit: what is left of an excess at the end stays within.
constexpr double begins = 0.92;

double turn_in_plane(const Pose& pose) { return std::atan2(pose.R(1, 0), pose.R(0, 0)); }

CellReading rotation_reading(const Structure& structure, const State& state, const CellHinges& cell) {
  CellReading reading;
  for (int k = 0; k < 4; ++k) {
    const int sense = structure.bodies[cell.bodies[k]].sense();
    reading.value += sense * turn_in_plane(state[cell.bodies[k]]) / 4;
    reading.bodies(0, k) = sense / 4.0;
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

double channel_value(Channel channel, const Structure& structure, const State& state,
                     const CellHinges& cell) {
  if (channel == Channel::aperture) return aperture(opening(structure, state, cell));
  return channel_reading(channel, structure, state, cell).value;
}

std::vector<double> channel_values(Channel channel, const Structure& structure, const State& state) {
  std::vector<double> values;
  for (const CellHinges& cell : structure.cell_members)
    values.push_back(channel_value(channel, structure, state, cell));
  return values;
}

CellReading channel_reading(Channel channel, const Structure& structure, const State& state,
                            const CellHinges& cell) {
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

DisplayProblem::DisplayProblem(PanelBalance& balance, const DisplayVariables& variables, Channel channel,
                               Cost cost, double stretch, double weight, Settling settling)
    : balance_(balance),
      variables_(variables),
      channel_(channel),
      cost_(std::move(cost)),
      stretch_(stretch),
      weight_(weight),
      settling_(settling),
      lower_(variables.lower()),
      upper_(variables.upper()) {}

bool DisplayProblem::evaluate(const VectorXd& x, double& f, VectorXd* gradient) {
  if (settling_ == Settling::from_flat) balance_.forget();
  if (!variables_.settle(balance_, x) || !weigh(f, gradient)) return false;
  if (f < least_) {
    least_ = f;
    stretch_of_best_ = hinge_gaps(balance_.panel(), balance_.state()).max;
    balance_.keep();
  }
  return true;
}

bool DisplayProblem::weigh(double& f, VectorXd* gradient) {
  Slopes slopes{VectorXd::Zero(6 * static_cast<Eigen::Index>(balance_.state().size())),
                VectorXd::Zero(static_cast<Eigen::Index>(balance_.panel().hinges.size()))};
  f = add_picture(slopes) + add_stretch(slopes);
  if (!gradient) return std::isfinite(f);
  auto by = balance_.slopes(slopes.state);
  if (!by) return false;
  by->t += slopes.t;
  *gradient = variables_.gather(*by);
  return std::isfinite(f) && gradient->allFinite();
}

double DisplayProblem::add_picture(Slopes& slopes) const {
  const Structure& panel = balance_.panel();
  std::vector<CellReading> readings;
  std::vector<double> values;
  for (const CellHinges& cell : panel.cell_members) {
    readings.push_back(channel_reading(channel_, panel, balance_.state(), cell));
    values.push_back(readings.back().value);
  }
  const WeighedReadings weighed = cost_(values);
  for (std::size_t k = 0; k < readings.size(); ++k)
    for (int m = 0; m < 4; ++m) {
      const Eigen::Index body = 6 * panel.cell_members[k].bodies[m];
      slopes.state.segment<3>(body + 2) += weighed.slope[k] * readings[k].bodies.col(m);
      slopes.t[panel.cell_members[k].hinges[m]] += weighed.slope[k] * readings[k].t[m];
    }
  return weighed.cost;
}

double DisplayProblem::add_stretch(Slopes& slopes) const {
  const Structure& panel = balance_.panel();
  double cost = 0;
  for (std::size_t h = 0; h < panel.hinges.size(); ++h) {
    const Hinge& hinge = panel.hinges[h];
    const Pose &lower = balance_.state()[hinge.lower], &upper = balance_.state()[hinge.upper];
    const Vector3d edge = edge_direction(hinge.wall.axis);
    const Vector3d lower_arm = lower.R * (hinge.parameters.t * edge),
                   upper_arm = upper.R * ((hinge.parameters.t - 1) * edge);
    const Vector3d gap = (lower.p - upper.p) / panel.size.edge_mm + lower_arm - upper_arm;
    const double excess = gap.norm() / stretch_ - begins;
    if (!(excess > 0)) continue;
    cost += weight_ * excess * excess;
    const Vector3d pull = 2 * weight_ * excess / stretch_ * gap.normalized();
    slopes.state.segment<3>(6 * hinge.lower) += lower_arm.cross(pull);
    slopes.state.segment<3>(6 * hinge.lower + 3) += pull;
    slopes.state.segment<3>(6 * hinge.upper) -= upper_arm.cross(pull);
    slopes.state.segment<3>(6 * hinge.upper + 3) -= pull;
    slopes.t[h] += pull.dot(lower.R * edge - upper.R * edge);
  }
  return cost;
}

}  // namespace kinetix
