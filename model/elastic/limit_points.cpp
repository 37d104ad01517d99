#include "model/elastic/limit_points.hpp"

#include <algorithm>
#include <cmath>

namespace kinetix::model {
namespace {

using Loads = std::vector<double>;

bool is_peak(const Loads& loads, std::size_t k) {
  return loads[k] > loads[k - 1] && loads[k] >= loads[k + 1];
}

/// How far the load falls from `k` on, before it is above loads[k] or ends.
template <class Iterator>
double fall(double from, Iterator begin, Iterator end) {
  double lowest = from;
  for (auto it = begin; it != end && *it <= from; ++it) lowest = std::min(lowest, *it);
  return from - lowest;
}

double prominence_of(const Loads& loads, std::size_t k) {
  const auto after = loads.begin() + static_cast<std::ptrdiff_t>(k) + 1;
  const auto before = loads.rbegin() + static_cast<std::ptrdiff_t>(loads.size() - k);
  return std::min(fall(loads[k], after, loads.end()), fall(loads[k], before, loads.rend()));
}

Loads signed_loads(const EquilibriumPath& path, double sign) {
  Loads loads;
  for (const EquilibriumStep& step : path.steps) loads.push_back(sign * step.load);
  return loads;
}

}  // namespace

std::vector<PathEvent> limit_points(const EquilibriumPath& path, double prominence) {
  const Loads loads = signed_loads(path, 1), mirrored = signed_loads(path, -1);
  const auto [low, high] = std::minmax_element(loads.begin(), loads.end());
  std::vector<PathEvent> found;
  for (std::size_t k = 1; k + 1 < loads.size(); ++k)
    for (const Loads* side : {&loads, &mirrored})
      if (is_peak(*side, k) && prominence_of(*side, k) >= prominence * (*high - *low))
        found.push_back({PathEvent::Kind::limit_point, path.steps[k], path.steps[k - 1].theta,
                         side == &loads ? "the load reached a maximum" : "the load reached a minimum"});
  return found;
}

void add_limit_points(EquilibriumPath& path) {
  const std::vector<PathEvent> limits = limit_points(path);
  path.events.insert(path.events.end(), limits.begin(), limits.end());
  std::stable_sort(path.events.begin(), path.events.end(), [](const PathEvent& a, const PathEvent& b) {
    return std::abs(a.at.theta) < std::abs(b.at.theta);
  });
}

}  // namespace kinetix::model
