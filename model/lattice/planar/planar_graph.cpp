#include "model/lattice/planar/planar_graph.hpp"

#include <map>
#include <optional>
#include <utility>

#include "model/base/algorithms.hpp"
#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector2d;

// Tolerance relative to the mean length of a wall: closer vertices are equal, and a closer vertex is on a wall.
// Coordinates in files have six digits or more.
constexpr double touching = 1e-6;

std::string name(const PlanarGraph& graph, int vertex) {
  const Vector2d& p = graph.vertices[vertex];
  return "vertex " + std::to_string(vertex) + " at (" + number_text(p.x()) + ", " + number_text(p.y()) + ")";
}

std::string name_of_edge(const PlanarGraph& graph, int edge) {
  return "the wall from vertex " + std::to_string(graph.edges[edge].from) + " to " +
         std::to_string(graph.edges[edge].to);
}

/// Directed edges: 2 edge from its `from`, 2 edge + 1 from its `to`.
struct Walks {
  explicit Walks(const PlanarGraph& graph) : graph_(graph), leaving_(graph.vertices.size()) {
    for (int e = 0; e < static_cast<int>(graph.edges.size()); ++e)
      for (const int walk : {2 * e, 2 * e + 1}) leaving_[start(walk)].push_back(walk);
    for (auto& walks : leaving_)
      std::sort(walks.begin(), walks.end(), [&](int a, int b) { return angle(a) < angle(b); });
    place_.resize(2 * graph.edges.size());
    for (const auto& walks : leaving_)
      for (std::size_t k = 0; k < walks.size(); ++k) place_[walks[k]] = static_cast<int>(k);
  }

  int count() const { return static_cast<int>(place_.size()); }
  int start(int walk) const {
    return walk % 2 == 0 ? graph_.edges[walk / 2].from : graph_.edges[walk / 2].to;
  }
  /// Returns the next walk with the same face on its left: the next one clockwise from the reverse walk.
  int next(int walk) const {
    const int back = walk ^ 1;
    const auto& walks = leaving_[start(back)];
    const int count = static_cast<int>(walks.size());
    return walks[(place_[back] + count - 1) % count];
  }

 private:
  double angle(int walk) const {
    const Vector2d along = graph_.along(walk / 2) * (walk % 2 == 0 ? 1 : -1);
    return std::atan2(along.y(), along.x());
  }

  const PlanarGraph& graph_;
  std::vector<std::vector<int>> leaving_;  ///< walks from each vertex, counter-clockwise
  std::vector<int> place_;                 ///< index of each walk among them
};

/// Removes walks that are followed by their reverse.
std::vector<int> without_dead_ends(const std::vector<int>& loop) {
  std::vector<int> kept;
  for (const int walk : loop) {
    if (!kept.empty() && kept.back() == (walk ^ 1))
      kept.pop_back();
    else
      kept.push_back(walk);
  }
  std::size_t first = 0;
  while (kept.size() > first + 1 && kept[first] == (kept.back() ^ 1)) {
    ++first;
    kept.pop_back();
  }
  kept.erase(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(first));
  return kept;
}

/// Returns every walk once, in closed loops.
std::vector<std::vector<int>> loops(const Walks& walks) {
  std::vector<bool> walked(walks.count(), false);
  std::vector<std::vector<int>> all;
  for (int first = 0; first < walks.count(); ++first) {
    if (walked[first]) continue;
    all.emplace_back();
    for (int walk = first; !walked[walk]; walk = walks.next(walk)) {
      walked[walk] = true;
      all.back().push_back(walk);
    }
  }
  return all;
}

GraphFace face_of(const Walks& walks, const std::vector<int>& loop) {
  GraphFace face;
  for (const int walk : loop) {
    face.vertices.push_back(walks.start(walk));
    face.edges.push_back(walk / 2);
  }
  return face;
}

double twice_area(const PlanarGraph& graph, const std::vector<int>& vertices) {
  double sum = 0;
  for (std::size_t k = 0; k < vertices.size(); ++k)
    sum += cross(graph.vertices[vertices[k]], graph.vertices[vertices[(k + 1) % vertices.size()]]);
  return sum;
}

/// Pairs of edges that are near each other, found by the grid squares that they pass.
class NearEdges {
 public:
  explicit NearEdges(const PlanarGraph& graph) : graph_(graph) {
    for (int e = 0; e < static_cast<int>(graph.edges.size()); ++e) mean_ += graph.along(e).norm();
    mean_ /= static_cast<double>(graph.edges.size());
  }

  double mean_length() const { return mean_; }

  template <class Visit>
  void visit(const Visit& visit) {
    for (int e = 0; e < static_cast<int>(graph_.edges.size()); ++e) {
      std::vector<int> met;
      for_squares(e, [&](const std::pair<long, long>& square) {
        auto& there = squares_[square];
        met.insert(met.end(), there.begin(), there.end());
        there.push_back(e);
      });
      std::sort(met.begin(), met.end());
      met.erase(std::unique(met.begin(), met.end()), met.end());
      for (const int other : met) visit(other, e);
    }
  }

 private:
  /// Visits all squares that an edge passes, with a margin.
  template <class Visit>
  void for_squares(int edge, const Visit& visit) const {
    Vector2d a = graph_.vertices[graph_.edges[edge].from] / mean_,
             b = graph_.vertices[graph_.edges[edge].to] / mean_;
    if (a.x() > b.x()) std::swap(a, b);
    constexpr double margin = 2 * touching;
    const auto square = [](double place) { return std::lround(std::floor(place)); };
    const auto y_at = [&](double x) {
      return a.x() == b.x() ? b.y()
                            : a.y() + std::clamp((x - a.x()) / (b.x() - a.x()), 0.0, 1.0) * (b.y() - a.y());
    };
    for (long i = square(a.x() - margin); i <= square(b.x() + margin); ++i) {
      const double x = static_cast<double>(i), from = a.x() == b.x() ? a.y() : y_at(x - margin),
                   to = y_at(x + 1 + margin);
      for (long j = square(std::min(from, to) - margin); j <= square(std::max(from, to) + margin); ++j)
        visit({i, j});
    }
  }

  const PlanarGraph& graph_;
  double mean_ = 0;
  std::map<std::pair<long, long>, std::vector<int>> squares_;
};

bool share_an_end(const GraphEdge& a, const GraphEdge& b) {
  return a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to;
}

void check_pair(const PlanarGraph& graph, int first, int second, double near) {
  const GraphEdge &a = graph.edges[first], &b = graph.edges[second];
  const Vector2d &p = graph.vertices[a.from], &q = graph.vertices[a.to], &r = graph.vertices[b.from],
                 &s = graph.vertices[b.to];
  for (const int end : {b.from, b.to})
    if (end != a.from && end != a.to && distance_to_wall(graph.vertices[end], p, q) <= near)
      throw InvalidInput(name(graph, end) + " lies on " + name_of_edge(graph, first) +
                         ". Split that wall there");
  for (const int end : {a.from, a.to})
    if (end != b.from && end != b.to && distance_to_wall(graph.vertices[end], r, s) <= near)
      throw InvalidInput(name(graph, end) + " lies on " + name_of_edge(graph, second) +
                         ". Split that wall there");
  if (share_an_end(a, b)) return;
  // The signs below are rounding noise for walls on one line.
  Eigen::AlignedBox2d around(p), other(r);
  if (!around.extend(q).intersects(other.extend(s))) return;
  const bool apart = (cross(q - p, r - p) > 0) == (cross(q - p, s - p) > 0) ||
                     (cross(s - r, p - r) > 0) == (cross(s - r, q - r) > 0);
  if (!apart)
    throw InvalidInput(name_of_edge(graph, first) + " crosses " + name_of_edge(graph, second) +
                       ". Split both at a vertex: walls may only meet at vertices");
}

void check_edges(const PlanarGraph& graph) {
  const int count = static_cast<int>(graph.vertices.size());
  std::map<std::pair<int, int>, int> seen;
  for (const GraphEdge& e : graph.edges) {
    if (e.from < 0 || e.to < 0 || e.from >= count || e.to >= count)
      throw InvalidInput("a wall from vertex " + std::to_string(e.from) + " to " + std::to_string(e.to) +
                         ", but vertices go from 0 to " + std::to_string(count - 1));
    const bool is_zero = e.from == e.to || graph.vertices[e.from] == graph.vertices[e.to];
    if (is_zero)
      throw InvalidInput("the wall from vertex " + std::to_string(e.from) + " to " + std::to_string(e.to) +
                         " has no length");
    if (++seen[std::minmax(e.from, e.to)] > 1)
      throw InvalidInput("the wall from vertex " + std::to_string(e.from) + " to " + std::to_string(e.to) +
                         " is there twice");
  }
}

void check_one_piece(const PlanarGraph& graph) {
  UnionFind pieces(graph.vertices.size());
  for (const GraphEdge& e : graph.edges) pieces.unite(e.from, e.to);
  for (int v = 0; v < static_cast<int>(graph.vertices.size()); ++v)
    if (pieces.find(v) != pieces.find(0))
      throw InvalidInput("the walls are not connected: there is no path from " + name(graph, 0) + " to " +
                         name(graph, v) +
                         ". Connect them by walls. If the lines are cuts in a sheet, use `structure.cuts`");
}

}  // namespace

std::string to_string(const GraphEdge& edge) {
  return "[" + std::to_string(edge.from) + ", " + std::to_string(edge.to) + "]";
}

std::string to_string(const GraphFace& face) {
  std::string text;
  for (const int v : face.vertices) text += (text.empty() ? "" : ", ") + std::to_string(v);
  return "the face of vertices " + text;
}

std::vector<GraphFace> bounded_faces(const PlanarGraph& graph) {
  const Walks walks(graph);
  std::vector<GraphFace> faces;
  for (const std::vector<int>& loop : loops(walks)) {
    GraphFace face = face_of(walks, without_dead_ends(loop));
    if (twice_area(graph, face.vertices) > 0) faces.push_back(std::move(face));
  }
  return faces;
}

GraphFace outer_boundary(const PlanarGraph& graph) {
  const Walks walks(graph);
  GraphFace rim;
  double least = 0;
  for (std::vector<int> loop : loops(walks)) {
    std::reverse(loop.begin(), loop.end());
    for (int& walk : loop) walk ^= 1;
    GraphFace face = face_of(walks, loop);
    const double area = twice_area(graph, face.vertices);
    if (area < least) continue;
    least = area;
    rim = std::move(face);
  }
  return rim;
}

std::vector<int> senses(const PlanarGraph& graph, const std::vector<GraphFace>& faces) {
  for (const GraphFace& face : faces)
    if (face.vertices.size() % 2 != 0)
      throw InvalidInput(
          to_string(face) + " has " + std::to_string(face.vertices.size()) +
          " walls: bodies turn to one side and to the other in turn, which takes an even number. Add or "
          "remove a wall there");
  std::vector<std::vector<int>> neighbours(graph.vertices.size());
  for (const GraphEdge& e : graph.edges) {
    neighbours[e.from].push_back(e.to);
    neighbours[e.to].push_back(e.from);
  }
  std::vector<int> senses(graph.vertices.size(), 0), open = {0};
  senses[0] = 1;
  while (!open.empty()) {
    const int at = open.back();
    open.pop_back();
    for (const int next : neighbours[at])
      if (senses[next] == 0) {
        senses[next] = -senses[at];
        open.push_back(next);
      }
  }
  return senses;
}

void validate(const PlanarGraph& graph) {
  if (graph.vertices.size() < 2 || graph.edges.empty())
    throw InvalidInput("a lattice needs at least two vertices and a wall between them");
  for (int v = 0; v < static_cast<int>(graph.vertices.size()); ++v)
    if (!graph.vertices[v].allFinite())
      throw InvalidInput("vertex " + std::to_string(v) +
                         " has a coordinate that is not finite. Give finite numbers");
  check_edges(graph);
  NearEdges near(graph);
  const double distance = touching * near.mean_length();
  near.visit([&](int a, int b) { check_pair(graph, a, b, distance); });
  check_one_piece(graph);
}

}  // namespace kinetix::model
