#include "targets/drawing/cut_sheet.hpp"

#include <fmt/format.h>
#include <boost/geometry/algorithms/comparable_distance.hpp>
#include <boost/geometry/algorithms/distance.hpp>
#include <boost/geometry/algorithms/equals.hpp>
#include <boost/geometry/algorithms/intersects.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/strategies/strategies.hpp>

#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <queue>

#include "model/base/algorithms.hpp"
#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::targets {
namespace {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;
using Eigen::Vector2d;
using GapPoint = bg::model::d2::point_xy<double>;
using GapBox = bg::model::box<GapPoint>;
using GapMap = bgi::rtree<std::pair<GapBox, int>, bgi::quadratic<16>>;

const double ahead =
    std::cos(75 * radians_per_degree);  // of the angle between a cut and the bridge at its end
const double behind =
    std::cos(55 * radians_per_degree);  // of the angle of a cut behind its tip, at a gap's distance
constexpr double bridge_share = 0.5;    // of the median cut: wider gaps are not narrow places
constexpr int bridge_corners = 16;      // of the polygon round its middle
// Ratio to half the width of a bridge: the corners of two pieces that turn by 90 degrees to each other just meet there.
constexpr double bridge_radius = std::numbers::sqrt2;
constexpr double same_cut = 3;  // gaps: a cut that returns within this length along it does not face itself
constexpr double blunt_reach = 3;    // gaps: a slot goes back within this distance of its blunt end
constexpr double same_place = 0.75;  // gaps: bridges of round ends with ends this near are one
constexpr double nearly = 1e-4;      // ratio: gaps that differ by less are equal
// Ratio to the nearest point: an end or a junction of cuts this near is taken instead, which keeps bridges symmetric.
constexpr double as_good = 1.25;
constexpr std::size_t max_gap_pairs = 20 << 20;  // pairs of a tip and a line, some seconds

GapBox gap_box(const Vector2d& a, const Vector2d& b, double margin) {
  const Vector2d low = a.cwiseMin(b).array() - margin, high = a.cwiseMax(b).array() + margin;
  return {GapPoint(low.x(), low.y()), GapPoint(high.x(), high.y())};
}

/// Returns whether two segments cross at a point that is inside both.
bool cross_inside(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const Vector2d along = b - a, other = d - c;
  const double turn = model::cross(along, other);
  if (std::abs(turn) <= 1e-12 * along.norm() * other.norm()) return false;
  const double s = model::cross(c - a, other) / turn, t = model::cross(c - a, along) / turn;
  return s > 1e-9 && s < 1 - 1e-9 && t > 1e-9 && t < 1 - 1e-9;
}

/// Point of a line that faces a tip.
struct FacingPoint {
  Vector2d place;
  double gap = 0;
  int vertex = -1;  ///< if it is an end of the line; else -1
};

class BridgeFinder {
 public:
  BridgeFinder(const model::PlanarGraph& cuts, double widest, const std::vector<bool>& is_rim)
      : cuts_(cuts), widest_(widest), edges_of_(cuts.vertices.size()), on_rim_(cuts.vertices.size(), false) {
    std::vector<std::pair<GapBox, int>> boxes;
    for (int e = 0; e < static_cast<int>(cuts.edges.size()); ++e) {
      const auto [from, to] = cuts.edges[e];
      boxes.emplace_back(gap_box(cuts.vertices[from], cuts.vertices[to], 0), e);
      for (const int v : {from, to}) {
        edges_of_[v].push_back(e);
        if (is_rim[e]) on_rim_[v] = true;
      }
    }
    map_ = GapMap(boxes);
    find_slots();
  }

  std::vector<SheetBridge> run(const std::vector<bool>& ends_in_crease) {
    for (int v = 0; v < static_cast<int>(cuts_.vertices.size()); ++v) {
      if (ends_in_crease[v] || on_rim_[v] || edges_of_[v].empty()) continue;
      edges_of_[v].size() == 1 ? add_bridges_of_end(v) : add_bridge_of_tip(v);
    }
    return chosen();
  }

 private:
  struct Candidate {
    SheetBridge bridge;
    bool is_end = false;
  };

  /// Marks the vertices of slots: closed lines, and lines from the outline to the outline.
  void find_slots() {
    UnionFind groups(edges_of_.size());
    for (const auto& [from, to] : cuts_.edges)
      if (!on_rim_[from] && !on_rim_[to]) groups.unite(from, to);
    std::vector<bool> is_slot(edges_of_.size(), true);
    for (int v = 0; v < static_cast<int>(edges_of_.size()); ++v)
      if (edges_of_[v].size() != 2) is_slot[groups.find(v)] = false;
    for (int v = 0; v < static_cast<int>(edges_of_.size()); ++v) in_slot_.push_back(is_slot[groups.find(v)]);
  }

  Vector2d at(int vertex) const { return cuts_.vertices[vertex]; }
  int other_end(int edge, int v) const {
    return cuts_.edges[edge].from == v ? cuts_.edges[edge].to : cuts_.edges[edge].from;
  }

  void count_gap_pair() {
    if (++pairs_ > max_gap_pairs)
      throw InvalidInput(fmt::format(
          "too many lines are near each other. Set structure.bridge_mm to less than {:.3g}", widest_));
  }

  /// Returns the nearest points of all lines near a tip that do not end at it, nearest first.
  std::vector<FacingPoint> facing_points(int v) {
    const Vector2d p = at(v);
    std::vector<FacingPoint> out;
    for (auto found = map_.qbegin(bgi::intersects(gap_box(p, p, widest_))); found != map_.qend(); ++found) {
      count_gap_pair();
      const auto [from, to] = cuts_.edges[found->second];
      if (from == v || to == v) continue;
      const Vector2d along = at(to) - at(from);
      const double part = std::clamp((p - at(from)).dot(along) / along.squaredNorm(), 0.0, 1.0);
      FacingPoint point{at(from) + part * along, 0, part == 0 ? from : part == 1 ? to : -1};
      point.gap = (point.place - p).norm();
      if (point.gap > 0 && point.gap <= widest_) out.push_back(point);
    }
    std::sort(out.begin(), out.end(), [](const FacingPoint& a, const FacingPoint& b) {
      return std::pair(a.gap, a.vertex) < std::pair(b.gap, b.vertex);
    });
    return out;
  }

  bool is_visible(const Vector2d& from, const Vector2d& to) {
    for (auto found = map_.qbegin(bgi::intersects(gap_box(from, to, 0))); found != map_.qend(); ++found) {
      count_gap_pair();
      const auto [a, b] = cuts_.edges[found->second];
      if (cross_inside(from, to, at(a), at(b))) return false;
    }
    return true;
  }

  void add_bridges_of_end(int v) {
    const Vector2d p = at(v), along = (p - at(other_end(edges_of_[v].front(), v))).normalized();
    std::vector<FacingPoint> seen;
    for (const FacingPoint& point : facing_points(v)) {
      if (!seen.empty() && point.gap > as_good * seen.front().gap) break;
      if ((point.place - p).dot(along) >= ahead * point.gap && is_visible(p, point.place))
        seen.push_back(point);
    }
    if (seen.empty()) return;
    const auto is_special = [&](const FacingPoint& point) {
      return point.vertex >= 0 && edges_of_[point.vertex].size() != 2;
    };
    const auto special = std::find_if(seen.begin(), seen.end(), is_special);
    const FacingPoint best = special == seen.end() ? seen.front() : *special;
    candidates_.push_back({{p, best.place}, true});
    if (best.vertex < 0 || edges_of_[best.vertex].size() != 1) return;
    // Ends that are equally near: where four ends meet, a small piece remains between their bridges.
    for (const FacingPoint& point : seen)
      if (point.vertex >= 0 && point.vertex != best.vertex && edges_of_[point.vertex].size() == 1 &&
          point.gap <= (1 + nearly) * best.gap)
        candidates_.push_back({{p, point.place}, true});
  }

  void add_bridge_of_tip(int v) {
    const std::map<int, double> way = ways_from(v, same_cut * widest_);
    for (const FacingPoint& point : facing_points(v)) {
      if (is_same_cut(point, way)) continue;
      if (!is_visible(at(v), point.place)) continue;
      if (stays_behind(v, point, way, point.gap))
        candidates_.push_back({{at(v), point.place}, false});
      else if (in_slot_[v])
        add_blunt_bridge(v, point);
      return;
    }
  }

  /// Adds the bridge at the middle of a blunt end, which may be straight from a tip to another.
  void add_blunt_bridge(int v, const FacingPoint& point) {
    const double reach = blunt_reach * point.gap;
    const std::map<int, double> way = ways_from(v, same_cut * reach);
    if (!stays_behind(v, point, way, reach)) return;
    const Vector2d along = (point.place - at(v)) / point.gap;
    Vector2d half(0, 0);
    for (const auto& [near, length] : way) {
      const Vector2d offset = at(near) - at(v);
      if (length <= (1 + nearly) * offset.norm() && std::abs(offset.dot(along)) <= nearly * point.gap &&
          offset.norm() > 2 * half.norm())
        half = offset / 2;
    }
    if (!is_on_cut(point.place + half, nearly * point.gap)) half.setZero();
    candidates_.push_back({{at(v) + half, point.place + half}, false});
  }

  bool is_on_cut(const Vector2d& p, double near) const {
    for (auto found = map_.qbegin(bgi::intersects(gap_box(p, p, near))); found != map_.qend(); ++found) {
      const auto [from, to] = cuts_.edges[found->second];
      if (model::distance_to_wall(p, at(from), at(to)) <= near) return true;
    }
    return false;
  }

  /// Returns the lengths of the ways along cuts to all vertices up to a distance.
  std::map<int, double> ways_from(int v, double most) {
    std::map<int, double> way;
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> open;
    open.push({0, v});
    while (!open.empty()) {
      const auto [length, here] = open.top();
      open.pop();
      if (length > most || !way.try_emplace(here, length).second) continue;
      for (const int e : edges_of_[here]) {
        count_gap_pair();
        const int next = other_end(e, here);
        if (!way.contains(next)) open.push({length + (at(next) - at(here)).norm(), next});
      }
    }
    return way;
  }

  bool is_same_cut(const FacingPoint& point, const std::map<int, double>& way) const {
    if (point.vertex >= 0) {
      const auto found = way.find(point.vertex);
      return found != way.end() && found->second <= same_cut * point.gap;
    }
    return std::any_of(way.begin(), way.end(), [&](const auto& near) {
      if (near.second > same_cut * point.gap) return false;
      const auto& edges = edges_of_[near.first];
      return std::any_of(edges.begin(), edges.end(), [&](int e) {
        const auto [from, to] = cuts_.edges[e];
        return model::distance_to_wall(point.place, at(from), at(to)) <= 1e-9 * point.gap;
      });
    });
  }

  /// Whether the cut of a tip stays behind it, as seen along the bridge, up to a distance.
  bool stays_behind(int v, const FacingPoint& point, const std::map<int, double>& way, double reach) const {
    const Vector2d along = (point.place - at(v)) / point.gap;
    const auto is_behind = [&](const Vector2d& offset) {
      return offset.norm() < (1 - nearly) * reach ? offset.dot(along) <= nearly * point.gap
                                                  : -offset.dot(along) >= behind * offset.norm();
    };
    for (const auto& [near, length] : way) {
      if (length > same_cut * reach) continue;
      for (const int e : edges_of_[near]) {
        const Vector2d from = at(near) - at(v), to = at(other_end(e, near)) - at(v);
        if (from.norm() > reach) continue;
        const Vector2d end = to.norm() <= reach ? to : on_circle(from, to, reach);
        if (!is_behind(end) || (near != v && !is_behind(from))) return false;
      }
    }
    return true;
  }

  /// Returns the point at which the way from a point inside a circle about 0 to one outside leaves the circle.
  static Vector2d on_circle(const Vector2d& from, const Vector2d& to, double radius) {
    const Vector2d along = to - from;
    const double a = along.squaredNorm(), b = from.dot(along), c = from.squaredNorm() - radius * radius;
    return from + (-b + std::sqrt(std::max(0.0, b * b - a * c))) / a * along;
  }

  /// Returns the candidates, narrowest first, without those that cross a narrower one or are the same place.
  std::vector<SheetBridge> chosen() {
    std::stable_sort(candidates_.begin(), candidates_.end(),
                     [](const Candidate& a, const Candidate& b) { return a.bridge.gap() < b.bridge.gap(); });
    std::vector<SheetBridge> out;
    GapMap accepted;
    for (const Candidate& candidate : candidates_) {
      const SheetBridge& bridge = candidate.bridge;
      bool is_new = true;
      const GapBox near = gap_box(bridge.from, bridge.to, bridge.gap());
      for (auto found = accepted.qbegin(bgi::intersects(near)); is_new && found != accepted.qend(); ++found) {
        count_gap_pair();
        const SheetBridge& other = out[found->second];
        is_new =
            !is_same_place(candidate, other) && !cross_inside(bridge.from, bridge.to, other.from, other.to);
      }
      if (!is_new) continue;
      accepted.insert({gap_box(bridge.from, bridge.to, 0), static_cast<int>(out.size())});
      out.push_back(bridge);
    }
    return out;
  }

  static bool is_same_place(const Candidate& candidate, const SheetBridge& other) {
    const SheetBridge& bridge = candidate.bridge;
    const double near = (candidate.is_end ? nearly : same_place) * bridge.gap();
    const auto match = [&](const Vector2d& a, const Vector2d& b) {
      return (bridge.from - a).norm() <= near && (bridge.to - b).norm() <= near;
    };
    return match(other.from, other.to) || match(other.to, other.from);
  }

  const model::PlanarGraph& cuts_;
  const double widest_;
  std::vector<std::vector<int>> edges_of_;
  std::vector<bool> on_rim_, in_slot_;
  GapMap map_;
  std::vector<Candidate> candidates_;
  std::size_t pairs_ = 0;
};

}  // namespace

double default_bridge(const model::PlanarGraph& cuts, const std::vector<bool>& is_rim) {
  UnionFind groups(cuts.vertices.size());
  for (std::size_t e = 0; e < cuts.edges.size(); ++e)
    if (!is_rim[e]) groups.unite(cuts.edges[e].from, cuts.edges[e].to);
  std::vector<double> length_of(cuts.vertices.size(), 0), lengths;
  std::vector<int> loops(cuts.vertices.size(), 0);  // edges less vertices
  for (std::size_t e = 0; e < cuts.edges.size(); ++e)
    if (!is_rim[e]) {
      const int group = groups.find(cuts.edges[e].from);
      length_of[group] += cuts.along(static_cast<int>(e)).norm();
      ++loops[group];
    }
  for (std::size_t v = 0; v < cuts.vertices.size(); ++v) --loops[groups.find(static_cast<int>(v))];
  for (std::size_t v = 0; v < length_of.size(); ++v)
    if (loops[v] >= 0) length_of[v] /= 2;
  std::copy_if(length_of.begin(), length_of.end(), std::back_inserter(lengths),
               [](double length) { return length > 0; });
  if (lengths.empty()) throw InvalidInput("the drawing has an outline, and no cuts. Draw each cut as a line");
  return bridge_share * lower_median(std::move(lengths));
}

model::FlatRing bridge_outline(const Vector2d& from, const Vector2d& to, double kerf_mm) {
  const double half = (to - from).norm() / 2, limit = half - kerf_mm / 2, radius = bridge_radius * half;
  const Vector2d along = (to - from).normalized(), across = model::turned_by_90(along);
  model::FlatRing out;
  for (int k = 0; k < bridge_corners; ++k) {
    const double angle = 2 * pi * k / bridge_corners;
    out.push_back((from + to) / 2 + std::clamp(radius * std::cos(angle), -limit, limit) * along +
                  radius * std::sin(angle) * across);
  }
  return out;
}

std::vector<SheetBridge> find_bridges(const model::PlanarGraph& cuts, double widest,
                                      const std::vector<bool>& is_rim,
                                      const std::vector<bool>& ends_in_crease) {
  return BridgeFinder(cuts, widest, is_rim).run(ends_in_crease);
}

}  // namespace kinetix::targets
