#include "model/lattice/planar/closed_boundary.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "model/base/geometry.hpp"

namespace kinetix::model {
namespace {

constexpr int pebbles = 3;  // pebbles per vertex: a body's two coordinates and its turn
// Pebbles of any set of vertices that always stay: three rigid motions, and the exact one
constexpr int stay = 4;

}  // namespace

WallDofs::WallDofs(const PlanarGraph& graph)
    : free_(graph.vertices.size(), pebbles), leads_to_(graph.vertices.size()) {
  for (const GraphEdge& wall : graph.edges) add_wall(wall);
}

void WallDofs::add_vertex() {
  free_.push_back(pebbles);
  leads_to_.emplace_back();
}

int WallDofs::add_wall(const GraphEdge& wall) {
  int held = 0;
  while (held < 2 && hold(wall.from, wall.to)) ++held;
  held_ += held;
  return held;
}

bool WallDofs::hold(int a, int b) {
  while (free_[a] + free_[b] <= stay)
    if (!fetch(a, b) && !fetch(b, a)) return false;
  const int giver = free_[a] > 0 ? a : b;
  --free_[giver];
  leads_to_[giver].push_back(giver == a ? b : a);
  return true;
}

/// Moves a free pebble along walls to a vertex and reverses the walls; a pebble at `keep` stays.
bool WallDofs::fetch(int to, int keep) {
  std::map<int, int> reached_from = {{to, to}, {keep, keep}};
  std::vector<int> open = {to};
  for (std::size_t k = 0; k < open.size(); ++k)
    for (const int next : leads_to_[open[k]]) {
      if (!reached_from.try_emplace(next, open[k]).second) continue;
      open.push_back(next);
      if (free_[next] == 0) continue;
      --free_[next];
      ++free_[to];
      for (int at = next; at != to; at = reached_from[at]) {
        const int before = reached_from[at];
        leads_to_[before].erase(std::find(leads_to_[before].begin(), leads_to_[before].end(), at));
        leads_to_[at].push_back(before);
      }
      return true;
    }
  return false;
}

namespace {

using Eigen::Vector2d;

// Rad: a wider outer corner is a straight boundary, not a notch
constexpr double open_corner = 175 * pi / 180;
// Rad: in a narrower corner new walls would touch the old ones
constexpr double narrow_corner = 40 * pi / 180;
// Wall lengths: bodies of nearer new and old vertices would collide as they turn
constexpr double apart = 0.3;

double mean_length(const PlanarGraph& graph) {
  double sum = 0;
  for (int e = 0; e < static_cast<int>(graph.edges.size()); ++e) sum += graph.along(e).norm();
  return sum / static_cast<double>(graph.edges.size());
}

using Segment = std::array<Vector2d, 2>;

/// Returns true if two walls keep `room` from each other, except at a shared end.
bool keep_off(const Segment& a, const Segment& b, double room) {
  const auto is_end = [](const Vector2d& p, const Segment& wall) { return p == wall[0] || p == wall[1]; };
  for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)})
    for (const Vector2d& end : one)
      if (!is_end(end, other) && distance_to_wall(end, other[0], other[1]) < room) return false;
  if (is_end(a[0], b) || is_end(a[1], b)) return true;
  return (cross(a[1] - a[0], b[0] - a[0]) > 0) == (cross(a[1] - a[0], b[1] - a[0]) > 0) ||
         (cross(b[1] - b[0], a[0] - b[0]) > 0) == (cross(b[1] - b[0], a[1] - b[0]) > 0);
}

/// Vertices along the boundary that a new cell uses, counter-clockwise, and the new vertex if needed.
struct Notch {
  std::vector<int> rim;
  bool has_corner = false;
  Vector2d corner = Vector2d::Zero();
  double sharpness = 0;  ///< rad, outer angle of the corner: the smallest is filled first
};

/// Boundary of a graph, and its notches.
class Boundary {
 public:
  explicit Boundary(const PlanarGraph& graph)
      : graph_(graph), boundary_(outer_boundary(graph).vertices), mean_(mean_length(graph)) {}

  /// Returns the notches that can be filled, of three walls first, then sharpest first.
  std::vector<Notch> notches() const {
    std::vector<Notch> found;
    for (int k = 0; k < size(); ++k) {
      if (!is_notch(k)) continue;
      if (Notch wide = of_three_walls(k); !wide.rim.empty()) found.push_back(std::move(wide));
      if (Notch corner = of_two_walls(k); !corner.rim.empty()) found.push_back(std::move(corner));
    }
    std::stable_sort(found.begin(), found.end(), [](const Notch& a, const Notch& b) {
      return std::pair(a.has_corner, std::round(a.sharpness * 1e6)) <
             std::pair(b.has_corner, std::round(b.sharpness * 1e6));
    });
    return found;
  }

 private:
  int size() const { return static_cast<int>(boundary_.size()); }
  int at(int k) const { return boundary_[(k % size() + size()) % size()]; }
  const Vector2d& place(int k) const { return graph_.vertices[at(k)]; }

  /// Returns the outer angle, rad, in (0, 2 pi).
  double outside(int k) const {
    const Vector2d back = place(k - 1) - place(k), on = place(k + 1) - place(k);
    const double angle = std::atan2(cross(back, on), back.dot(on));
    return angle < 0 ? angle + 2 * pi : angle;
  }

  bool is_notch(int k) const {
    const double angle = outside(k);
    return angle > narrow_corner && angle < open_corner;
  }

  Notch of_three_walls(int k) const {
    if (!is_notch(k + 1)) return {};
    const Vector2d &from = place(k - 1), &to = place(k + 2);
    const double length = (to - from).norm();
    if (length < mean_ / 2 || length > 2.5 * mean_ || !is_free(from, to)) return {};
    return {{at(k - 1), at(k), at(k + 1), at(k + 2)}, false, {}, outside(k)};
  }

  Notch of_two_walls(int k) const {
    const Vector2d corner = place(k - 1) + place(k + 1) - place(k);
    for (int j = 0; j < size(); ++j)
      if (distance_to_wall(corner, place(j), place(j + 1)) < apart * mean_) return {};
    if (!is_free(place(k - 1), corner) || !is_free(corner, place(k + 1))) return {};
    return {{at(k - 1), at(k), at(k + 1)}, true, corner, outside(k)};
  }

  /// Returns true if a wall between these places keeps off the boundary, except at its ends.
  bool is_free(const Vector2d& a, const Vector2d& b) const {
    for (int j = 0; j < size(); ++j)
      if (!keep_off({a, b}, {place(j), place(j + 1)}, apart * mean_)) return false;
    return true;
  }

  const PlanarGraph& graph_;
  std::vector<int> boundary_;
  double mean_;  ///< mean length of a wall, cell edges
};

/// Returns the walls that close the notch. @param corner number of its new vertex
std::vector<GraphEdge> walls_of(const Notch& notch, int corner) {
  const int from = notch.rim.front(), to = notch.rim.back();
  if (!notch.has_corner) return {{from, to}};
  return {{from, corner}, {to, corner}};
}

/// A growing graph, and its degrees of freedom.
struct Growing {
  PlanarGraph graph;
  WallDofs dofs;
};

/// Numbers of vertices and walls of a graph before additions.
struct Before {
  std::size_t vertices = 0, walls = 0;
};

/// Closes the notch if that removes a degree of freedom, away from all vertices and walls added since `before`.
/// @return true if it was closed
bool fill(const Notch& notch, const Before& before, double room, Growing& sheet) {
  for (std::size_t v = before.vertices; notch.has_corner && v < sheet.graph.vertices.size(); ++v)
    if ((sheet.graph.vertices[v] - notch.corner).norm() < room) return false;
  Growing next = sheet;
  if (notch.has_corner) {
    next.graph.vertices.push_back(notch.corner);
    next.dofs.add_vertex();
  }
  const auto segment = [&](const GraphEdge& e) {
    return Segment{next.graph.vertices[e.from], next.graph.vertices[e.to]};
  };
  for (const GraphEdge& wall : walls_of(notch, static_cast<int>(sheet.graph.vertices.size()))) {
    for (std::size_t e = before.walls; e < sheet.graph.edges.size(); ++e)
      if (!keep_off(segment(wall), segment(sheet.graph.edges[e]), room)) return false;
    next.graph.edges.push_back(wall);
    next.dofs.add_wall(wall);
  }
  if (next.dofs.count() >= sheet.dofs.count()) return false;
  sheet = std::move(next);
  return true;
}

/// Fills notches without common vertices, until the graph has one degree of freedom. @return true if there were any
bool fill_notches(Growing& sheet) {
  const std::vector<Notch> notches = Boundary(sheet.graph).notches();
  const Before before = {sheet.graph.vertices.size(), sheet.graph.edges.size()};
  const double room = apart * mean_length(sheet.graph);
  std::vector<bool> is_used(sheet.graph.vertices.size(), false);
  bool filled = false;
  for (const Notch& notch : notches) {
    if (sheet.dofs.count() <= 1) break;
    const auto used = [&](int v) { return is_used[v]; };
    const auto inner = notch.rim.begin() + 1, end = notch.rim.end() - 1;
    if (std::any_of(inner, end, used) || (used(notch.rim.front()) && used(notch.rim.back()))) continue;
    if (!fill(notch, before, room, sheet)) continue;
    for (const int v : notch.rim) is_used[v] = true;
    filled = true;
  }
  return filled;
}

/// Returns the shortest wall between corners of a cell three walls apart that keeps off the others. Empty if it would
/// leave the cell.
std::optional<GraphEdge> bar(const PlanarGraph& graph, const GraphFace& face, double room) {
  const int count = static_cast<int>(face.vertices.size());
  const auto place = [&](int k) { return graph.vertices[face.vertices[k % count]]; };
  for (int k = 0; k < count; ++k)
    if (cross(place(k + 1) - place(k), place(k + 2) - place(k + 1)) < -1e-9) return std::nullopt;
  std::optional<GraphEdge> best;
  double shortest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < count; ++k) {
    const double length = (place(k + 3) - place(k)).norm();
    bool is_free = true;
    for (int j = 0; j < count; ++j)
      is_free = is_free && keep_off({place(k), place(k + 3)}, {place(j), place(j + 1)}, room);
    if (length > shortest - 1e-9 || !is_free) continue;
    shortest = length;
    best = {face.vertices[k], face.vertices[(k + 3) % count]};
  }
  return best;
}

/// Adds walls across cells of six and more walls, those along the boundary first. @return true if any was added
bool add_bars(Growing& sheet) {
  PlanarGraph& graph = sheet.graph;
  const double room = apart * mean_length(graph);
  bool added = false;
  std::vector<bool> on_boundary(graph.edges.size(), false);
  for (const int e : outer_boundary(graph).edges) on_boundary[e] = true;
  std::vector<GraphFace> faces = bounded_faces(graph);
  std::stable_partition(faces.begin(), faces.end(), [&](const GraphFace& face) {
    return std::any_of(face.edges.begin(), face.edges.end(), [&](int e) { return on_boundary[e]; });
  });
  for (const GraphFace& face : faces) {
    if (sheet.dofs.count() <= 1) break;
    if (face.vertices.size() < 6) continue;
    const auto wall = bar(graph, face, room);
    if (!wall || sheet.dofs.add_wall(*wall) == 0) continue;
    graph.edges.push_back(*wall);
    added = true;
  }
  return added;
}

}  // namespace

int counted_dofs(const PlanarGraph& graph) {
  return 3 * static_cast<int>(graph.vertices.size()) - 2 * static_cast<int>(graph.edges.size()) - 3;
}

PlanarGraph closed_boundary(PlanarGraph graph) {
  if (counted_dofs(graph) <= 1) return graph;
  Growing sheet{graph, WallDofs(graph)};
  while (sheet.dofs.count() > 1 && fill_notches(sheet)) {
  }
  while (sheet.dofs.count() > 1 && add_bars(sheet)) {
  }
  return sheet.graph;
}

}  // namespace kinetix::model
