#include "model/lattice/planar/planar_lattices.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "model/base/angle.hpp"
#include "model/base/invalid_input.hpp"
#include "model/base/union_find.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector2d;

constexpr double grid =
    1e-6;  // wall lengths: vertices of neighbouring cells this near are one, rounding is 1e-13

/// Collects cells by their corners; corners and walls that cells share are there once.
class Drawing {
 public:
  void add_cell(const std::vector<Vector2d>& corners) {
    for (std::size_t k = 0; k < corners.size(); ++k) add_wall(corners[k], corners[(k + 1) % corners.size()]);
  }

  /// Vertices from below, and from the left in a row.
  PlanarGraph graph() const {
    std::vector<int> order(vertices_.size()), place(vertices_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return key(vertices_[a]) < key(vertices_[b]); });
    PlanarGraph out;
    for (std::size_t k = 0; k < order.size(); ++k) {
      place[order[k]] = static_cast<int>(k);
      out.vertices.push_back(vertices_[order[k]]);
    }
    std::set<std::pair<int, int>> walls;
    for (const auto& [a, b] : walls_) walls.insert(std::minmax(place[a], place[b]));
    for (const auto& [a, b] : walls) out.edges.push_back({a, b});
    return out;
  }

 private:
  static std::pair<long, long> key(const Vector2d& p) {
    return {std::lround(p.y() / grid), std::lround(p.x() / grid)};
  }

  int vertex(const Vector2d& p) {
    const auto [at, is_new] = index_.try_emplace(key(p), static_cast<int>(vertices_.size()));
    if (is_new) vertices_.push_back(p);
    return at->second;
  }

  void add_wall(const Vector2d& from, const Vector2d& to) {
    const int a = vertex(from), b = vertex(to);
    walls_.insert(std::minmax(a, b));
  }

  std::vector<Vector2d> vertices_;
  std::map<std::pair<long, long>, int> index_;
  std::set<std::pair<int, int>> walls_;
};

template <class Corners>
PlanarGraph tiled(int columns, int rows, const Corners& corners) {
  Drawing drawing;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) drawing.add_cell(corners(i, j));
  return drawing.graph();
}

std::vector<Vector2d> moved(std::vector<Vector2d> corners, const Vector2d& by) {
  for (Vector2d& p : corners) p += by;
  return corners;
}

/// Regular polygon with walls of length 1, its first corner at `first` from its middle, rad.
std::vector<Vector2d> polygon(int walls, double first) {
  const double radius = 0.5 / std::sin(pi / walls);
  std::vector<Vector2d> corners;
  for (int k = 0; k < walls; ++k) {
    const double angle = first + 2 * pi * k / walls;
    corners.push_back(radius * Vector2d(std::cos(angle), std::sin(angle)));
  }
  return corners;
}

/// The graph of the walls of some faces.
PlanarGraph of_faces(const PlanarGraph& graph, const std::vector<const GraphFace*>& faces) {
  Drawing drawing;
  for (const GraphFace* face : faces) {
    std::vector<Vector2d> corners;
    for (const int v : face->vertices) corners.push_back(graph.vertices[v]);
    drawing.add_cell(corners);
  }
  return drawing.graph();
}

/// The faces of the largest piece that hangs together by walls.
std::vector<const GraphFace*> largest_piece(const PlanarGraph& graph,
                                            const std::vector<const GraphFace*>& faces) {
  UnionFind pieces(faces.size());
  std::vector<int> face_at(graph.edges.size(), -1);
  for (int f = 0; f < static_cast<int>(faces.size()); ++f)
    for (const int e : faces[f]->edges) {
      if (face_at[e] >= 0) pieces.unite(face_at[e], f);
      face_at[e] = f;
    }
  std::vector<int> count(faces.size(), 0);
  for (int f = 0; f < static_cast<int>(faces.size()); ++f) ++count[pieces.find(f)];
  const int largest = static_cast<int>(std::max_element(count.begin(), count.end()) - count.begin());
  std::vector<const GraphFace*> kept;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f)
    if (pieces.find(f) == largest) kept.push_back(faces[f]);
  return kept;
}

}  // namespace

PlanarGraph square_graph(int columns, int rows) { return rhombus_graph(columns, rows, pi / 2); }

PlanarGraph rhombus_graph(int columns, int rows, double angle) {
  const Vector2d along(1, 0), across(std::cos(angle), std::sin(angle));
  return tiled(columns, rows, [&](int i, int j) {
    return moved({{0, 0}, along, along + across, across}, i * along + j * across);
  });
}

PlanarGraph honeycomb_graph(int columns, int rows) {
  const double width = std::sqrt(3.0);
  return tiled(columns, rows, [&](int i, int j) {
    return moved(polygon(6, pi / 2), Vector2d(width * (i + 0.5 * (j % 2)), 1.5 * j));
  });
}

PlanarGraph brick_graph(int columns, int rows) {
  return tiled(columns, rows, [](int i, int j) {
    return moved({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}}, Vector2d(2 * i + j % 2, j));
  });
}

PlanarGraph octagon_graph(int columns, int rows) {
  const double pitch = 1 + std::sqrt(2.0);
  return tiled(columns, rows, [&](int i, int j) {
    return moved(polygon(8, pi / 8), {pitch * i, pitch * j});
  });
}

PlanarGraph trimmed(const PlanarGraph& graph, const std::function<bool(const Vector2d&)>& inside) {
  const std::vector<GraphFace> faces = bounded_faces(graph);
  std::vector<const GraphFace*> kept;
  for (const GraphFace& face : faces)
    if (std::all_of(face.vertices.begin(), face.vertices.end(),
                    [&](int v) { return inside(graph.vertices[v]); }))
      kept.push_back(&face);
  if (kept.empty()) throw InvalidInput("no cell of the lattice lies inside the outline; use smaller cells");
  return of_faces(graph, largest_piece(graph, kept));
}

}  // namespace kinetix::model
