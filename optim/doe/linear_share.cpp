#include <algorithm>
#include <cmath>

#include "optim/doe/analysis.hpp"

#include "optim/doe/nan.hpp"

namespace kinetix::optim {

Estimate linear_share(std::span<const double> correlations, std::int64_t used) {
  constexpr double sds = 1.96;  // standard deviations of 95 %
  if (used < 3) return {nan, nan, nan};
  double squares = 0;
  int varying = 0;
  for (const double r : correlations)
    if (std::isfinite(r)) {
      squares += r * r;
      ++varying;
    }
  if (varying == 0) return {nan, nan, nan};
  const double free = static_cast<double>(used - 1), by_chance = varying / free;
  const double share = (squares - by_chance) * free / (free - 1), bounded = std::clamp(share, 0.0, 1.0),
               sd = std::sqrt(2 * varying / (free * free) + 4 * bounded / free);
  return {share, std::max(share - sds * sd, 0.0), std::min(share + sds * sd, 1.0)};
}

}  // namespace kinetix::optim
