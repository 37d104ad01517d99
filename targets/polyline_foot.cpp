#include "targets/polyline_foot.hpp"

#include <algorithm>
#include <cmath>

namespace kinetix {
namespace {

using Eigen::Vector2d;

/// Left normal at a foot; at a corner the mean of both segments' normals decides the side.
Vector2d left_normal(const std::vector<Vector2d>& points, const Foot& foot) {
  const auto normal = [&](int k) { return left_of(points[k + 1] - points[k]).normalized(); };
  const int last = static_cast<int>(points.size()) - 2;
  if (foot.fraction == 1 && foot.segment < last) return normal(foot.segment) + normal(foot.segment + 1);
  if (foot.fraction == 0 && foot.segment > 0) return normal(foot.segment) + normal(foot.segment - 1);
  return normal(foot.segment);
}

void add_side(const std::vector<Vector2d>& points, const Vector2d& p, Foot& foot) {
  const Vector2d left = left_normal(points, foot), offset = p - foot.point;
  const double size = offset.norm(), side = offset.dot(left) < 0 ? -1 : 1;
  foot.distance = side * size;
  const bool on_the_line = !(size > 1e-12 * (points[foot.segment + 1] - points[foot.segment]).norm());
  foot.normal = on_the_line ? left.normalized() : Vector2d(side / size * offset);
}

/// Foot without side: distance is unsigned, normal not set.
Foot plain_foot(const std::vector<Vector2d>& points, int k, const Vector2d& p) {
  const Vector2d along = points[k + 1] - points[k];
  Foot foot;
  foot.segment = k;
  foot.fraction = fraction_along(points[k], along, p);
  foot.point = points[k] + foot.fraction * along;
  foot.distance = (p - foot.point).norm();
  return foot;
}

}  // namespace

Foot foot_on_segment(const std::vector<Vector2d>& points, int k, const Vector2d& p) {
  Foot foot = plain_foot(points, k, p);
  add_side(points, p, foot);
  return foot;
}

Foot foot_near(const std::vector<Vector2d>& points, int start, const Vector2d& p) {
  const int last = static_cast<int>(points.size()) - 2;
  Foot best = plain_foot(points, std::clamp(start, 0, last), p);
  for (const int step : {1, -1}) {
    for (int k = best.segment + step; k >= 0 && k <= last; k += step) {
      const Foot next = plain_foot(points, k, p);
      if (!(next.distance < best.distance)) break;
      best = next;
    }
  }
  add_side(points, p, best);
  return best;
}

}  // namespace kinetix
