#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <numeric>
#include <vector>

namespace kinetix::targets {

/// Calls visit(first, second), first < second, for each pair of segments whose ranges along one axis come within
/// `near` of each other. The axis is the one along which the points spread most. Segment k joins points k and k + 1.
/// The sweep along the axis takes n log n time for curves that do not crowd it.
/// @param points at least 2, finite, in any unit. @param near >= 0, in that unit
template <class Point, class Visit>
void for_segment_pairs(const std::vector<Point>& points, double near, const Visit& visit) {
  Point lowest = points[0], highest = points[0];
  for (const Point& p : points) {
    lowest = lowest.cwiseMin(p);
    highest = highest.cwiseMax(p);
  }
  int axis = 0;
  (highest - lowest).maxCoeff(&axis);
  const auto low = [&](int k) { return std::min(points[k][axis], points[k + 1][axis]); };
  const auto high = [&](int k) { return std::max(points[k][axis], points[k + 1][axis]); };
  std::vector<int> order(points.size() - 1), active;
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return low(a) < low(b); });
  for (const int k : order) {
    std::erase_if(active, [&](int a) { return high(a) < low(k) - near; });
    for (const int a : active) visit(std::min(a, k), std::max(a, k));
    active.push_back(k);
  }
}

}  // namespace kinetix::targets
