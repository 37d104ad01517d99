#include "targets/mesh/winding_number.hpp"

#include <cmath>
#include <numbers>

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;

/// Distance from which a branch is summed as a whole, in its radii. The third term of its series, the first to be left
/// out, is then about a tenth of the first. (2 is twice as fast and errs by 0.07, 4 by 0.016 in twice the time.)
constexpr double far_in_radii = 3;

}  // namespace

double solid_angle(const std::array<Vector3d, 3>& corners, const Vector3d& p) {
  const Vector3d a = corners[0] - p, b = corners[1] - p, c = corners[2] - p;
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

WindingNumber::WindingNumber(TriangleTree tree) : tree_(std::move(tree)) {
  const auto& branches = tree_.branches();
  moments_.resize(branches.size());
  for (std::size_t k = branches.size(); k-- > 0;) {
    const bool is_last = branches[k].count > 0;
    const int end = is_last ? branches[k].first + branches[k].count : moments_[branches[k].second].end;
    moments_[k] = moments_of(branches[k].first, end);
  }
}

WindingNumber::Moments WindingNumber::moments_of(int first, int end) const {
  Moments out;
  out.end = end;
  const auto each = [&](const auto& add) {
    for (int k = first; k < end; ++k) {
      const auto& [a, b, c] = tree_.leaves()[k].corners;
      add(Vector3d((b - a).cross(c - a) / 2), Vector3d((a + b + c) / 3), tree_.leaves()[k].corners);
    }
  };
  double size = 0;
  each([&](const Vector3d& area, const Vector3d& centroid, const auto&) {
    out.area += area;
    out.center += area.norm() * centroid;
    size += area.norm();
  });
  out.center = size > 0 ? Vector3d(out.center / size) : tree_.leaves()[first].corners[0];
  each([&](const Vector3d& area, const Vector3d& centroid, const auto& corners) {
    out.spread += area * (centroid - out.center).transpose();
    for (const Vector3d& p : corners) out.radius = std::max(out.radius, (p - out.center).norm());
  });
  return out;
}

double WindingNumber::angle_below(int branch, const Vector3d& p) const {
  const Moments& all = moments_[branch];
  const Vector3d d = all.center - p;
  const double r = d.norm();
  if (r > far_in_radii * all.radius)
    return (all.area.dot(d) + all.spread.trace() - 3 * d.dot(all.spread * d) / (r * r)) / (r * r * r);
  const TriangleTree::Branch& at = tree_.branches()[branch];
  double sum = 0;
  for (int k = at.first; k < at.first + at.count; ++k) sum += solid_angle(tree_.leaves()[k].corners, p);
  return at.count > 0 ? sum : angle_below(branch + 1, p) + angle_below(at.second, p);
}

double WindingNumber::at(const Vector3d& p) const { return angle_below(0, p) / (4 * std::numbers::pi); }

}  // namespace kinetix::targets
