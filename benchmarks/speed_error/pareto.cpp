#include "benchmarks/speed_error/pareto.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace kinetix::bench {
namespace {

template <class Predicate>
MeasuredPoints chosen(const MeasuredPoints& points, const Predicate& is_wanted) {
  MeasuredPoints some;
  std::copy_if(points.begin(), points.end(), std::back_inserter(some), is_wanted);
  return some;
}

bool is_of_bullet(const MeasuredPoint& point) { return point.method.starts_with("Bullet"); }

}  // namespace

MeasuredPoints pareto_front(const MeasuredPoints& points) {
  MeasuredPoints front, sorted = chosen(points, [](const MeasuredPoint&p) {
                          return std::isfinite(p.seconds) && p.seconds > 0 && std::isfinite(p.error);
                        });
  std::stable_sort(sorted.begin(), sorted.end(), [](const MeasuredPoint& a, const MeasuredPoint& b) {
    return std::tie(a.seconds, a.error) < std::tie(b.seconds, b.error);
  });
  for (const MeasuredPoint& p : sorted)
    if (front.empty() || p.error < front.back().error) front.push_back(p);
  return front;
}

std::optional<MeasuredPoint> fastest_at(const MeasuredPoints& points, double error) {
  for (const MeasuredPoint& p : pareto_front(points))
    if (p.error <= error) return p;
  return std::nullopt;
}

MeasuredPoints of_series(const MeasuredPoints& points, const std::string& series) {
  return chosen(points, [&](const MeasuredPoint& p) { return series_of(p) == series; });
}

MeasuredPoints of_bullet(const MeasuredPoints& points) { return chosen(points, is_of_bullet); }

MeasuredPoints without_bullet(const MeasuredPoints& points) {
  return chosen(points, [](const MeasuredPoint& p) { return !is_of_bullet(p); });
}

std::vector<std::string> series_in(const MeasuredPoints& points) {
  std::vector<std::string> names;
  for (const MeasuredPoint& p : points)
    if (std::find(names.begin(), names.end(), series_of(p)) == names.end()) names.push_back(series_of(p));
  return names;
}

}  // namespace kinetix::bench
