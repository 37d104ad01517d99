#include "targets/mesh/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;

/// Most corners of a clipped triangle: six planes add one each to its three, and one is to spare.
constexpr int most_corners = 10;

struct Polygon {
  std::array<Vector3d, most_corners> corners;
  int count = 0;

  void add(const Vector3d& p) { corners[count++] = p; }
};

/// Cuts a polygon to its part with sign * coordinate <= limit (Sutherland and Hodgman 1974).
Polygon clipped(const Polygon& polygon, int coordinate, double sign, double limit) {
  Polygon kept;
  for (int k = 0; k < polygon.count; ++k) {
    const Vector3d &p = polygon.corners[k], &q = polygon.corners[(k + 1) % polygon.count];
    const double beyond_p = sign * p[coordinate] - limit, beyond_q = sign * q[coordinate] - limit;
    if (beyond_p <= 0) kept.add(p);
    if ((beyond_p <= 0) != (beyond_q <= 0)) kept.add(p + beyond_p / (beyond_p - beyond_q) * (q - p));
  }
  return kept;
}

}  // namespace

bool is_in_box(const std::array<Vector3d, 3>& corners, const OrientedBox& box) {
  Polygon left;
  for (const Vector3d& p : corners) left.add(box.axes.transpose() * (p - box.center));
  for (int c = 0; c < 3; ++c)
    for (const double sign : {-1.0, 1.0}) left = clipped(left, c, sign, box.half[c]);
  return left.count > 0;
}

namespace {

using Corners = std::array<Eigen::Vector3d, 3>;

// Triangles: fewer make more boxes to visit, more make more triangles to measure.
constexpr int leaf_size = 4;
constexpr double infinity = std::numeric_limits<double>::infinity();
/// Deepest level of the tree. Each level halves the triangles, so no mesh that fits in memory gets deeper.
constexpr int deepest = 64;
/// Slack of a ray's hit, as a fraction of the triangle's size (of the ray's length for boxes). Rays that miss by less
/// still hit, so that none slips through between two.
constexpr double ray_slack = 1e-9;

Vector3d nearest_on_segment(const Vector3d& a, const Vector3d& b, const Vector3d& p) {
  const Vector3d along = b - a;
  const double squared = along.squaredNorm();
  return squared > 0 ? Vector3d(a + std::clamp((p - a).dot(along) / squared, 0.0, 1.0) * along) : a;
}

Vector3d nearest_on_sides(const Corners& c, const Vector3d& p) {
  Vector3d best = c[0];
  for (int k = 0; k < 3; ++k) {
    const Vector3d q = nearest_on_segment(c[k], c[(k + 1) % 3], p);
    if ((q - p).squaredNorm() < (best - p).squaredNorm()) best = q;
  }
  return best;
}

bool lacks_area(const Corners& c) {
  const Vector3d ab = c[1] - c[0], ac = c[2] - c[0];
  const double longest = std::max(ab.squaredNorm(), ac.squaredNorm());
  return !(ab.cross(ac).squaredNorm() > 1e-24 * longest * longest);
}

/// Finds the nearest point by the region of the triangle's plane that p is over (Ericson 2005, Real-Time Collision
/// Detection, 5.1.5).
Vector3d nearest_by_regions(const Corners& c, const Vector3d& p) {
  const Vector3d ab = c[1] - c[0], ac = c[2] - c[0], ap = p - c[0], bp = p - c[1], cp = p - c[2];
  const double ab_ap = ab.dot(ap), ac_ap = ac.dot(ap);
  if (ab_ap <= 0 && ac_ap <= 0) return c[0];
  const double ab_bp = ab.dot(bp), ac_bp = ac.dot(bp);
  if (ab_bp >= 0 && ac_bp <= ab_bp) return c[1];
  const double of_c = ab_ap * ac_bp - ab_bp * ac_ap;
  if (of_c <= 0 && ab_ap >= 0 && ab_bp <= 0) return c[0] + ab_ap / (ab_ap - ab_bp) * ab;
  const double ab_cp = ab.dot(cp), ac_cp = ac.dot(cp);
  if (ac_cp >= 0 && ab_cp <= ac_cp) return c[2];
  const double of_b = ab_cp * ac_ap - ab_ap * ac_cp;
  if (of_b <= 0 && ac_ap >= 0 && ac_cp <= 0) return c[0] + ac_ap / (ac_ap - ac_cp) * ac;
  const double of_a = ab_bp * ac_cp - ab_cp * ac_bp, from_b = ac_bp - ab_bp, from_c = ab_cp - ac_cp;
  if (of_a <= 0 && from_b >= 0 && from_c >= 0) return c[1] + from_b / (from_b + from_c) * (c[2] - c[1]);
  const double sum = of_a + of_b + of_c;
  return c[0] + of_b / sum * ab + of_c / sum * ac;
}

double squared_gap(const Eigen::AlignedBox3d& box, const Vector3d& p) {
  return (box.min() - p).cwiseMax(p - box.max()).cwiseMax(0).squaredNorm();
}

/// Whether and where the ray meets the triangle. (Moeller and Trumbore 1997)
std::optional<double> hit(const Corners& c, const Vector3d& origin, const Vector3d& direction) {
  const Vector3d e1 = c[1] - c[0], e2 = c[2] - c[0], across = direction.cross(e2);
  const double determinant = e1.dot(across);
  if (!(std::abs(determinant) > 0)) return std::nullopt;
  const Vector3d from = origin - c[0], turned = from.cross(e1);
  const double u = from.dot(across) / determinant, v = direction.dot(turned) / determinant;
  const double t = e2.dot(turned) / determinant;
  const bool meets = u >= -ray_slack && v >= -ray_slack && u + v <= 1 + ray_slack && t >= 0;
  return meets && std::isfinite(t) ? std::optional(t) : std::nullopt;
}

/// Returns the ray's parameter where it leaves the box; -1 if it misses the box.
double leaves_at(const Eigen::AlignedBox3d& box, const Vector3d& origin, const Vector3d& direction) {
  double enter = 0, leave = infinity;
  for (int c = 0; c < 3; ++c) {
    if (direction[c] == 0) {
      if (origin[c] < box.min()[c] || origin[c] > box.max()[c]) return -1;
      continue;
    }
    const double a = (box.min()[c] - origin[c]) / direction[c], b = (box.max()[c] - origin[c]) / direction[c];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  const double slack = ray_slack * std::abs(leave);
  return enter <= leave + slack ? leave + slack : -1;
}

/// Branches still to visit.
class Pending {
 public:
  explicit Pending(int first) { push(first); }
  bool empty() const { return size_ == 0; }
  void push(int branch) { branches_[size_++] = branch; }
  int pop() { return branches_[--size_]; }

 private:
  std::array<int, 2 * deepest> branches_;
  int size_ = 0;
};

}  // namespace

Vector3d nearest_on_triangle(const Corners& c, const Vector3d& p) {
  return lacks_area(c) ? nearest_on_sides(c, p) : nearest_by_regions(c, p);
}

TriangleTree::TriangleTree(const TriangleMesh& mesh) {
  const int count = static_cast<int>(mesh.triangles.size());
  std::vector<Vector3d> centres(count);
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  for (int t = 0; t < count; ++t) centres[t] = mesh.box_of(t).center();
  branches_.reserve(count);
  build(centres, order, 0, count, mesh);
  leaves_.reserve(count);
  for (const int t : order) {
    const Corners corners = {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
    leaves_.push_back({corners, t, lacks_area(corners)});
  }
}

void TriangleTree::build(std::vector<Vector3d>& centres, std::vector<int>& order, int first, int count,
                         const TriangleMesh& mesh) {
  const auto from = order.begin() + first, to = from + count;
  Eigen::AlignedBox3d box, spread;
  std::for_each(from, to, [&](int t) {
    box.extend(mesh.box_of(t));
    spread.extend(centres[t]);
  });
  const std::size_t self = branches_.size();
  branches_.push_back({box, first, count <= leaf_size ? count : 0});
  if (count <= leaf_size) return;
  Eigen::Index axis = 0;
  spread.sizes().maxCoeff(&axis);
  std::nth_element(from, from + count / 2, to, [&](int a, int b) {
    return std::pair(centres[a][axis], a) < std::pair(centres[b][axis], b);
  });
  build(centres, order, first, count / 2, mesh);
  branches_[self].second = static_cast<int>(branches_.size());
  build(centres, order, first + count / 2, count - count / 2, mesh);
}

NearestPlace TriangleTree::nearest(const Vector3d& p) const {
  NearestPlace best;
  best.squared_distance = infinity;
  for (Pending pending(0); !pending.empty();) {
    const int at = pending.pop();
    const Branch& branch = branches_[at];
    if (squared_gap(branch.box, p) >= best.squared_distance) continue;
    for (int k = branch.first; k < branch.first + branch.count; ++k) {
      const Leaf& leaf = leaves_[k];
      const Vector3d q =
          leaf.lacks_area ? nearest_on_sides(leaf.corners, p) : nearest_by_regions(leaf.corners, p);
      const double squared = (q - p).squaredNorm();
      if (squared < best.squared_distance) best = {leaf.triangle, q, squared};
    }
    if (branch.count > 0) continue;
    const bool second_first =
        squared_gap(branches_[branch.second].box, p) < squared_gap(branches_[at + 1].box, p);
    pending.push(second_first ? at + 1 : branch.second);
    pending.push(second_first ? branch.second : at + 1);
  }
  return best;
}

std::optional<double> TriangleTree::farthest_hit(const Vector3d& origin, const Vector3d& direction) const {
  double farthest = -1;
  for (Pending pending(0); !pending.empty();) {
    const int at = pending.pop();
    const Branch& branch = branches_[at];
    if (leaves_at(branch.box, origin, direction) <= farthest) continue;
    for (int k = branch.first; k < branch.first + branch.count; ++k)
      farthest = std::max(farthest, hit(leaves_[k].corners, origin, direction).value_or(-1));
    if (branch.count > 0) continue;
    pending.push(at + 1);
    pending.push(branch.second);
  }
  return farthest < 0 ? std::nullopt : std::optional(farthest);
}

bool TriangleTree::is_hit(const Vector3d& origin, const Vector3d& direction) const {
  for (Pending pending(0); !pending.empty();) {
    const int at = pending.pop();
    const Branch& branch = branches_[at];
    if (leaves_at(branch.box, origin, direction) < 0) continue;
    for (int k = branch.first; k < branch.first + branch.count; ++k)
      if (hit(leaves_[k].corners, origin, direction)) return true;
    if (branch.count > 0) continue;
    pending.push(at + 1);
    pending.push(branch.second);
  }
  return false;
}

bool TriangleTree::touches(const OrientedBox& box) const {
  const Vector3d reach = box.axes.cwiseAbs() * box.half;
  const Eigen::AlignedBox3d around(box.center - reach, box.center + reach);
  for (Pending pending(0); !pending.empty();) {
    const int at = pending.pop();
    const Branch& branch = branches_[at];
    if (!branch.box.intersects(around)) continue;
    for (int k = branch.first; k < branch.first + branch.count; ++k)
      if (is_in_box(leaves_[k].corners, box)) return true;
    if (branch.count > 0) continue;
    pending.push(at + 1);
    pending.push(branch.second);
  }
  return false;
}

namespace {

/// Largest distance of a closest point on the mesh, as a fraction of the distance to the inner point. For nearer
/// points the direction to them would be that of rounding errors.
constexpr double on_the_mesh = 1e-10;

/// Returns the unit vector along the direction, turned to face away from the inner point; along `away` for a zero
/// direction.
Vector3d outward(const Vector3d& direction, const Vector3d& away) {
  const double size = direction.norm();
  if (!(size > 0)) return away.normalized();
  return direction.dot(away) < 0 ? Vector3d(-direction / size) : Vector3d(direction / size);
}

}  // namespace

MeshDistance::MeshDistance(TriangleMesh mesh, const Vector3d& inside)
    : mesh_(std::move(mesh)), tree_(mesh_), inside_(inside) {}

ClosestMeshPoint MeshDistance::closest(const Vector3d& p) const {
  const NearestPlace place = tree_.nearest(p);
  const Vector3d away = place.point - inside_, offset = p - place.point;
  const double size = std::sqrt(place.squared_distance);
  ClosestMeshPoint closest;
  closest.triangle = place.triangle;
  closest.point = place.point;
  closest.distance = offset.dot(away) < 0 ? -size : size;
  closest.face_normal = outward(area_normal(mesh_, place.triangle), away);
  const bool is_on_it = !(size > on_the_mesh * away.norm());
  closest.normal = is_on_it ? closest.face_normal : Vector3d(offset / closest.distance);
  return closest;
}

}  // namespace kinetix::targets
