#include "optim/display/channel.hpp"

#include <cmath>

#include "model/opening/cell_opening.hpp"

namespace kinetix::optim {
namespace {

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

/// Returns the reading of a cell in a channel that depends on the cell alone.
model::CellReading reading(Channel channel, const model::Linkage& panel, const model::State& state,
                           const model::LinkageCell& cell) {
  if (channel == Channel::rotation) return rotation_reading(panel, state, cell);
  const model::Opening seen = opening(panel, state, cell);
  return channel == Channel::area ? area_reading(seen) : soft_aperture(seen);
}

}  // namespace

std::string to_string(Channel channel) {
  switch (channel) {
    case Channel::aperture:
      return "aperture";
    case Channel::area:
      return "area";
    case Channel::rotation:
      return "rotation";
    case Channel::light:
      break;
  }
  return "light";
}

std::vector<double> channel_values(Channel channel, const model::Linkage& panel, const model::State& state) {
  if (channel != Channel::aperture) return SmoothChannel(channel, panel, state).values();
  std::vector<double> values;
  for (const model::LinkageCell& cell : panel.cells) values.push_back(aperture(opening(panel, state, cell)));
  return values;
}

SmoothChannel::SmoothChannel(Channel channel, const model::Linkage& panel, const model::State& state)
    : panel_(panel) {
  if (channel == Channel::light) {
    light_.emplace(panel, state);
    values_ = light_->values();
    return;
  }
  for (const model::LinkageCell& cell : panel.cells) {
    readings_.push_back(reading(channel, panel, state, cell));
    values_.push_back(readings_.back().value);
  }
}

void SmoothChannel::add_gradient(const Eigen::VectorXd& by_value, model::PanelGradient& gradient) const {
  if (light_) return light_->add_gradient(by_value, gradient);
  for (std::size_t c = 0; c < readings_.size(); ++c) {
    const model::LinkageCell& cell = panel_.cells[c];
    for (std::size_t m = 0; m < cell.bodies.size(); ++m) {
      gradient.state.segment<3>(6 * cell.bodies[m] + 2) += by_value[c] * readings_[c].bodies.col(m);
      gradient.t[cell.hinges[m]] += by_value[c] * readings_[c].t[m];
    }
  }
}

}  // namespace kinetix::optim
