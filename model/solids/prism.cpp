#include "model/solids/prism.hpp"

#include <algorithm>
#include <limits>

#include "model/base/geometry.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector2d;

/// Cuts a polygon with holes into triangles. Each hole is joined to the outline by a line traversed in both directions.
/// Then corners are cut off one after the other.
class PolygonCutter {
 public:
  explicit PolygonCutter(const std::vector<FlatRing>& rings) {
    std::vector<std::vector<int>> loops;
    for (const FlatRing& ring : rings) {
      loops.emplace_back();
      for (const Vector2d& corner : ring) {
        loops.back().push_back(static_cast<int>(corners_.size()));
        corners_.push_back(corner);
      }
    }
    loop_ = loops.front();
    loops.erase(loops.begin());
    const auto rightmost = [&](const std::vector<int>& loop) {
      return *std::max_element(loop.begin(), loop.end(),
                               [&](int a, int b) { return corners_[a].x() < corners_[b].x(); });
    };
    // From the right: the line from a hole then crosses no hole that is not joined yet.
    std::sort(loops.begin(), loops.end(), [&](const auto& a, const auto& b) {
      return corners_[rightmost(a)].x() > corners_[rightmost(b)].x();
    });
    for (const std::vector<int>& hole : loops) join(hole, rightmost(hole));
  }

  std::vector<std::array<int, 3>> triangles() {
    std::vector<std::array<int, 3>> out;
    std::size_t at = 0, tried = 0;
    while (loop_.size() > 3) {
      const std::size_t count = loop_.size();
      at %= count;
      // After a whole round without an ear, rounding hides it: the next convex corner is cut off.
      if (is_ear(at) || (tried >= count && turn(at) > 0) || tried >= 2 * count) {
        out.push_back({before(at), loop_[at], after(at)});
        loop_.erase(loop_.begin() + static_cast<std::ptrdiff_t>(at));
        tried = 0;
      } else {
        ++tried;
        ++at;
      }
    }
    out.push_back({loop_[0], loop_[1], loop_[2]});
    return out;
  }

 private:
  int before(std::size_t k) const { return loop_[(k + loop_.size() - 1) % loop_.size()]; }
  int after(std::size_t k) const { return loop_[(k + 1) % loop_.size()]; }

  double side(int a, int b, int c) const {
    return cross(corners_[b] - corners_[a], corners_[c] - corners_[a]);
  }
  double turn(std::size_t k) const { return side(before(k), loop_[k], after(k)); }

  bool is_ear(std::size_t k) const {
    const int a = before(k), b = loop_[k], c = after(k);
    if (!(side(a, b, c) > 0)) return false;
    for (const int p : loop_) {
      if (corners_[p] == corners_[a] || corners_[p] == corners_[b] || corners_[p] == corners_[c]) continue;
      if (side(a, b, p) >= 0 && side(b, c, p) >= 0 && side(c, a, p) >= 0) return false;
    }
    return true;
  }

  /// Joins a hole from its rightmost corner to a corner of the loop that it sees.
  void join(const std::vector<int>& hole, int from) {
    const std::size_t to = visible_corner(corners_[from]);
    const auto start = std::find(hole.begin(), hole.end(), from);
    std::vector<int> way(start, hole.end());
    way.insert(way.end(), hole.begin(), start);
    way.push_back(from);
    way.push_back(loop_[to]);
    loop_.insert(loop_.begin() + static_cast<std::ptrdiff_t>(to) + 1, way.begin(), way.end());
  }

  /// Returns the position in the loop of a corner that p sees (D. Eberly, Triangulation by Ear Clipping). The ray from
  /// p along x meets an edge. If no corner is in the triangle of p, that point and the edge's right end, that end is
  /// visible. Otherwise the corner with the least slope from p is.
  std::size_t visible_corner(const Vector2d& p) const {
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t edge = 0;
    for (std::size_t k = 0; k < loop_.size(); ++k) {
      const Vector2d &a = corners_[loop_[k]], &b = corners_[after(k)];
      if (!(a.y() <= p.y() && b.y() > p.y())) continue;  // edges with the inside on their left
      const double x = a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      if (x >= p.x() && x < nearest) {
        nearest = x;
        edge = k;
      }
    }
    const std::size_t next = (edge + 1) % loop_.size();
    const std::size_t seen = corners_[loop_[edge]].x() > corners_[loop_[next]].x() ? edge : next;
    const Vector2d met(nearest, p.y()), end = corners_[loop_[seen]];
    const double sign = end.y() < p.y() ? -1 : 1;
    std::size_t best = seen;
    double least = slope(p, end), distance = (end - p).squaredNorm();
    for (std::size_t k = 0; k < loop_.size(); ++k) {
      const Vector2d& c = corners_[loop_[k]];
      if (c == end || !(sign * cross(met - p, c - p) >= 0 && sign * cross(end - met, c - met) >= 0 &&
                        sign * cross(p - end, c - end) >= 0))
        continue;
      if (turn(k) > 0 || c == p) continue;
      const double steep = slope(p, c), far = (c - p).squaredNorm();
      if (steep > least || (steep == least && far >= distance)) continue;
      best = k;
      least = steep;
      distance = far;
    }
    return best;
  }

  static double slope(const Vector2d& p, const Vector2d& c) {
    return std::atan2(std::abs(c.y() - p.y()), c.x() - p.x());
  }

  std::vector<Vector2d> corners_;
  std::vector<int> loop_;  ///< counter-clockwise
};

}  // namespace

Polyhedron make_prism(const std::vector<FlatRing>& rings, double bottom, double top) {
  Polyhedron out;
  int count = 0;
  for (const double height : {bottom, top})
    for (const FlatRing& ring : rings)
      for (const Vector2d& corner : ring) {
        out.add_point({corner.x(), corner.y(), height});
        count += height == bottom ? 1 : 0;
      }
  int first = 0;
  for (const FlatRing& ring : rings) {
    const int size = static_cast<int>(ring.size());
    for (int k = 0; k < size; ++k) {
      const int here = first + k, next = first + (k + 1) % size;
      out.triangles.push_back({here, next, count + next});
      out.triangles.push_back({here, count + next, count + here});
    }
    first += size;
  }
  for (const auto& [a, b, c] : PolygonCutter(rings).triangles()) {
    out.triangles.push_back({a, c, b});
    out.triangles.push_back({count + a, count + b, count + c});
  }
  return out;
}

}  // namespace kinetix::model
