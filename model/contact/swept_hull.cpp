#include "model/contact/swept_hull.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

/// Returns a lower bound of n . p over the points of a part, at tau, mm.
double lowest(const SweptHull& part, const Vector3d& n, double tau) {
  double least = std::numeric_limits<double>::infinity();
  for (const SweptPoints& p : part) {
    Vector3d d = n;
    double moved = 0;
    if (p.motion) {
      d += tau * n.cross(p.motion->omega());
      moved = tau * n.dot(p.motion->speed(Vector3d::Zero())) -
              tau * tau / 2 * p.motion->change_along(n, p.center, p.radius);
    }
    const Vector3d seen = p.pose.R.transpose() * d;
    const double low = (seen.transpose() * *p.points).minCoeff();
    least = std::min(least, low + d.dot(p.pose.p) + moved);
  }
  return least;
}

}  // namespace

double least_gap(const SweptHull& a, const SweptHull& b, const Vector3d& n, double half_width) {
  const auto gap = [&](double tau) { return lowest(b, n, tau) + lowest(a, -n, tau); };
  return half_width > 0 ? std::min(gap(half_width), gap(-half_width)) : gap(0);
}

double way(const SweptHull& part) {
  double most = 0;
  for (const SweptPoints& p : part)
    if (p.motion) most = std::max(most, p.motion->way(p.center, p.radius));
  return most;
}

}  // namespace kinetix::model
