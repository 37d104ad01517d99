#include "targets/display/display_score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace kinetix::targets {
namespace {

// Largest difference of two channel values that counts as none, in the channel's unit: above rounding. A smaller one
// would rank equal cells; a larger one would hide faint pictures.
constexpr double same = 1e-5;

/// Returns ranks from 1. Equal values share their mean rank. NaN values come last, each with a separate rank.
std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::isnan(values[b]) ? !std::isnan(values[a]) : values[a] < values[b];
  });
  std::vector<double> out(values.size());
  for (std::size_t from = 0, to = 0; from < order.size(); from = to) {
    to = from + 1;
    while (to < order.size() && values[order[to]] - values[order[from]] <= same) ++to;
    const double mean = (static_cast<double>(from + to) + 1) / 2;
    for (std::size_t k = from; k < to; ++k) out[order[k]] = mean;
  }
  return out;
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double variance(const std::vector<double>& values, double mean) {
  double sum = 0;
  for (const double v : values) sum += (v - mean) * (v - mean);
  return sum / static_cast<double>(values.size());
}

double contrast(double difference, double deviation) {
  if (std::abs(difference) <= same) return 0;
  return difference / std::max(deviation, same);
}

}  // namespace

DisplayScore display_score(const std::vector<double>& channel, const std::vector<double>& levels) {
  std::vector<double> letter, rest;
  for (std::size_t k = 0; k < channel.size(); ++k) (levels[k] >= 0.5 ? letter : rest).push_back(channel[k]);
  DisplayScore score;
  score.letter = mean_of(letter);
  score.rest = mean_of(rest);
  const double deviation = std::sqrt((variance(letter, score.letter) + variance(rest, score.rest)) / 2);
  score.contrast = contrast(score.separation(), deviation);
  if (!std::isfinite(score.letter + score.rest)) {
    score.contrast = score.auc = std::numeric_limits<double>::quiet_NaN();
    return score;
  }
  const std::vector<double> rank = ranks(channel);
  double sum = 0;
  for (std::size_t k = 0; k < rank.size(); ++k) sum += levels[k] >= 0.5 ? rank[k] : 0;
  const double n = static_cast<double>(letter.size()), m = static_cast<double>(rest.size());
  score.auc = (sum - n * (n + 1) / 2) / (n * m);
  return score;
}

double rank_correlation(const std::vector<double>& channel, const std::vector<double>& levels) {
  const std::vector<double> a = ranks(channel), b = ranks(levels);
  const double mean = mean_of(a), deviations = std::sqrt(variance(a, mean) * variance(b, mean));
  if (!(deviations > 0)) return 0;
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - mean) * (b[k] - mean);
  return sum / static_cast<double>(a.size()) / deviations;
}

}  // namespace kinetix::targets
