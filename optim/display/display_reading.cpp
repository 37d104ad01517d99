#include "optim/display/display_reading.hpp"

#include <limits>

#include "model/tolerance/print_tolerance.hpp"

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

namespace {

bool is_binary(const std::vector<double>& levels) {
  return std::all_of(levels.begin(), levels.end(), [](double l) { return l == 0 || l == 1; });
}

/// Smallest variance that counts, in the channel's unit squared: a picture of contrast 1e6 is perfect.
constexpr double perfect = 1e-12;

}  // namespace

PictureCost::PictureCost(std::vector<double> levels)
    : weights_(levels.size(), 1.0 / static_cast<double>(levels.size())), centred_(std::move(levels)) {
  if (is_binary(centred_)) {
    const double letter = static_cast<double>(std::count(centred_.begin(), centred_.end(), 1.0));
    const double rest = static_cast<double>(centred_.size()) - letter;
    for (std::size_t k = 0; k < centred_.size(); ++k) weights_[k] = 0.5 / (centred_[k] == 1 ? letter : rest);
  }
  const double middle = mean(centred_);
  for (std::size_t k = 0; k < centred_.size(); ++k) {
    centred_[k] -= middle;
    spread_ += weights_[k] * centred_[k] * centred_[k];
  }
}

double PictureCost::mean(const std::vector<double>& readings) const {
  double sum = 0;
  for (std::size_t k = 0; k < weights_.size(); ++k) sum += weights_[k] * readings[k];
  return sum;
}

WeightedReadings PictureCost::for_separation(const std::vector<double>& readings, double separation) const {
  const double middle = mean(readings);
  WeightedReadings out;
  out.slope = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(readings.size()));
  for (std::size_t k = 0; k < weights_.size(); ++k) {
    const double residual = readings[k] - middle - separation * centred_[k];
    out.cost += weights_[k] * residual * residual;
    out.slope[k] = 2 * weights_[k] * residual;
  }
  return out;
}

WeightedReadings PictureCost::for_contrast(const std::vector<double>& readings) const {
  double slope = 0;
  for (std::size_t k = 0; k < weights_.size(); ++k)
    slope += weights_[k] * centred_[k] * readings[k] / spread_;
  WeightedReadings out = for_separation(readings, slope);
  if (!(slope > 0)) {
    out.cost = std::numeric_limits<double>::infinity();
    return out;
  }
  const double variance = out.cost + perfect;
  out.cost = std::log(variance) - 2 * std::log(slope);
  for (std::size_t k = 0; k < weights_.size(); ++k)
    out.slope[k] = out.slope[k] / variance - 2 / slope * weights_[k] * centred_[k] / spread_;
  return out;
}

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Cells of the letter or of the rest: their mean, and the variance about it.
struct Group {
  std::vector<Eigen::Index> cells;
  double mean = 0;      ///< of the design
  double variance = 0;  ///< expected over prints
  double variance_of_variance = 0;
  VectorXd mean_gradient;  ///< of the mean by each error
};

Group group(const std::vector<double>& readings, const std::vector<double>& levels,
            const MatrixXd& derivatives, bool letter) {
  Group g;
  for (std::size_t k = 0; k < levels.size(); ++k)
    if ((levels[k] >= 0.5) == letter) g.cells.push_back(static_cast<Eigen::Index>(k));
  const auto count = static_cast<double>(g.cells.size());
  MatrixXd own(g.cells.size(), derivatives.cols());
  VectorXd values(g.cells.size());
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    own.row(k) = derivatives.row(g.cells[k]);
    values[k] = readings[g.cells[k]];
  }
  g.mean = values.mean();
  g.mean_gradient = own.colwise().mean();
  own.rowwise() -= g.mean_gradient.transpose();
  values.array() -= g.mean;
  // Variance of the quadratic form |values + own e|^2 / count in normal e.
  const MatrixXd covariance = own * own.transpose();
  g.variance = (values.squaredNorm() + covariance.trace()) / count;
  g.variance_of_variance =
      (2 * covariance.squaredNorm() + 4 * (own.transpose() * values).squaredNorm()) / (count * count);
  return g;
}

/// Returns the mean over all pairs of the probability that the letter's cell reads more.
double expected_auc(const std::vector<double>& readings, const Group& letter, const Group& rest,
                    const MatrixXd& derivatives) {
  double sum = 0;
  for (const Eigen::Index a : letter.cells)
    for (const Eigen::Index b : rest.cells) {
      const double apart = readings[a] - readings[b], sd = (derivatives.row(a) - derivatives.row(b)).norm();
      sum += sd > 0 ? 0.5 * std::erfc(-apart / (sd * std::sqrt(2.0))) : (apart > 0) + 0.5 * (apart == 0);
    }
  return sum / static_cast<double>(letter.cells.size() * rest.cells.size());
}

}  // namespace

DisplayTolerance analyse_display_tolerance(const std::vector<double>& readings,
                                           const std::vector<double>& levels, const MatrixXd& derivatives) {
  const Group letter = group(readings, levels, derivatives, true),
              rest = group(readings, levels, derivatives, false);
  const double apart = letter.mean - rest.mean, variance = (letter.variance + rest.variance) / 2;
  const double apart_sd = (letter.mean_gradient - rest.mean_gradient).norm(),
               variance_sd = std::sqrt(letter.variance_of_variance + rest.variance_of_variance) / 2;
  DisplayTolerance out;
  out.contrast = apart / std::sqrt(variance);
  const double sd = std::hypot(apart_sd / std::sqrt(variance), out.contrast * variance_sd / (2 * variance));
  out.contrast_p05 = out.contrast - model::quantile_95 * sd;
  out.auc = expected_auc(readings, letter, rest, derivatives);
  return out;
}

}  // namespace kinetix::optim
