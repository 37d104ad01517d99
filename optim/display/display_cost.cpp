#include "optim/display/display_cost.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kinetix::optim {
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

WeighedReadings PictureCost::for_separation(const std::vector<double>& readings, double separation) const {
  const double middle = mean(readings);
  WeighedReadings out;
  out.slope = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(readings.size()));
  for (std::size_t k = 0; k < weights_.size(); ++k) {
    const double residual = readings[k] - middle - separation * centred_[k];
    out.cost += weights_[k] * residual * residual;
    out.slope[k] = 2 * weights_[k] * residual;
  }
  return out;
}

WeighedReadings PictureCost::for_contrast(const std::vector<double>& readings) const {
  double slope = 0;
  for (std::size_t k = 0; k < weights_.size(); ++k)
    slope += weights_[k] * centred_[k] * readings[k] / spread_;
  WeighedReadings out = for_separation(readings, slope);
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

}  // namespace kinetix::optim
