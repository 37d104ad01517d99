#include "model/lattice/planar/planar_lattice.hpp"

#include <limits>
#include <map>
#include <set>
#include <utility>

#include "model/base/algorithms.hpp"
#include "model/base/invalid_input.hpp"
#include "model/lattice/planar/closed_boundary.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector2d;

// Wall lengths: nearer vertices of neighbouring cells are equal, rounding is 1e-13
constexpr double grid = 1e-6;

/// Collects cells by their corners; shared corners and walls are stored once.
class LatticeDrawing {
 public:
  void add_cell(const std::vector<Vector2d>& corners) {
    for (std::size_t k = 0; k < corners.size(); ++k) add_wall(corners[k], corners[(k + 1) % corners.size()]);
  }

  /// Returns the graph. Vertices are ordered from below, and from the left in a row.
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

/// Returns the graph of the walls of some faces.
PlanarGraph of_faces(const PlanarGraph& graph, const std::vector<const GraphFace*>& faces) {
  LatticeDrawing drawing;
  for (const GraphFace* face : faces) {
    std::vector<Vector2d> corners;
    for (const int v : face->vertices) corners.push_back(graph.vertices[v]);
    drawing.add_cell(corners);
  }
  return drawing.graph();
}

/// Returns the faces of the largest piece that is connected by walls.
std::vector<const GraphFace*> largest_piece(const PlanarGraph& graph,
                                            const std::vector<const GraphFace*>& faces) {
  UnionFind pieces(faces.size());
  std::vector<int> face_at(graph.edges.size(), -1);
  for (int f = 0; f < static_cast<int>(faces.size()); ++f)
    for (const int e : faces[f]->edges) {
      if (face_at[e] >= 0) pieces.unite(face_at[e], f);
      face_at[e] = f;
    }
  std::vector<const GraphFace*> kept;
  for (const int f : pieces.largest()) kept.push_back(faces[f]);
  return kept;
}

}  // namespace

std::vector<LatticeCell> lattice_cells(int columns, int rows) {
  std::vector<LatticeCell> cells;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) cells.push_back({i, j});
  return cells;
}

PlanarGraph lattice_graph(const LatticeSheet& sheet) {
  LatticeDrawing drawing;
  for (const auto& [i, j] : sheet.cells) drawing.add_cell(sheet.lattice->corners(i, j, sheet.angle));
  return sheet.closed_boundary ? closed_boundary(drawing.graph()) : drawing.graph();
}

PlanarGraph lattice_graph(const PlanarLattice& lattice, int columns, int rows, double angle) {
  return lattice_graph({&lattice, lattice_cells(columns, rows), angle});
}

PlanarGraph trimmed(const PlanarGraph& graph, const std::function<bool(const Vector2d&)>& inside) {
  const std::vector<GraphFace> faces = bounded_faces(graph);
  std::vector<const GraphFace*> kept;
  for (const GraphFace& face : faces)
    if (std::all_of(face.vertices.begin(), face.vertices.end(),
                    [&](int v) { return inside(graph.vertices[v]); }))
      kept.push_back(&face);
  if (kept.empty()) throw InvalidInput("no cell of the lattice lies inside the outline. Use smaller cells");
  return of_faces(graph, largest_piece(graph, kept));
}

namespace {

// Extra columns around the rectangle, and extra pairs of rows, which are lower: room for slightly larger regions.
constexpr int margin = 2;
// Cell edges: nearer middles of walls are equal. Rounding is 1e-13 and walls are far apart.
constexpr double one_wall = 1e-4;

Vector2d middle_of(const PlanarLattice& lattice, const LatticeCell& cell, double angle) {
  const std::vector<Vector2d> corners = lattice.corners(cell[0], cell[1], angle);
  Vector2d sum = Vector2d::Zero();
  for (const Vector2d& corner : corners) sum += corner;
  return sum / static_cast<double>(corners.size());
}

std::pair<long, long> key(const Vector2d& p) {
  return {std::lround(p.x() / one_wall), std::lround(p.y() / one_wall)};
}

std::vector<LatticeCell> largest_cells(const PlanarLattice& lattice, double angle,
                                       const std::vector<LatticeCell>& cells) {
  UnionFind pieces(cells.size());
  std::map<std::pair<long, long>, int> cell_at;  // by middles of walls
  for (int c = 0; c < static_cast<int>(cells.size()); ++c) {
    const auto corners = lattice.corners(cells[c][0], cells[c][1], angle);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto wall = key((corners[k] + corners[(k + 1) % corners.size()]) / 2);
      if (const auto [at, is_new] = cell_at.try_emplace(wall, c); !is_new) pieces.unite(at->second, c);
    }
  }
  std::vector<LatticeCell> kept;
  for (const int c : pieces.largest()) kept.push_back(cells[c]);
  return kept;
}

std::vector<LatticeCell> from_zero(std::vector<LatticeCell> cells) {
  LatticeCell low = {std::numeric_limits<int>::max(), std::numeric_limits<int>::max()};
  for (const LatticeCell& cell : cells) low = {std::min(low[0], cell[0]), std::min(low[1], cell[1])};
  low[1] -= odd_row(low[1]);
  for (LatticeCell& cell : cells) cell = {cell[0] - low[0], cell[1] - low[1]};
  std::sort(cells.begin(), cells.end(), [](const LatticeCell& a, const LatticeCell& b) {
    return std::pair(a[1], a[0]) < std::pair(b[1], b[0]);
  });
  return cells;
}

}  // namespace

LatticePitch lattice_pitch(const PlanarLattice& lattice, double angle) {
  const Vector2d first = middle_of(lattice, {0, 0}, angle);
  return {middle_of(lattice, {1, 0}, angle) - first, (middle_of(lattice, {0, 2}, angle) - first) / 2};
}

Eigen::AlignedBox2d lattice_box(const PlanarLattice& lattice, int columns, int rows, double angle) {
  Eigen::AlignedBox2d box;
  for (const auto& [i, j] : lattice_cells(columns, rows))
    for (const Vector2d& corner : lattice.corners(i, j, angle)) box.extend(corner);
  return box;
}

std::vector<LatticeCell> cut_cells(const PlanarLattice& lattice, int columns, int rows, double angle,
                                   const std::function<bool(const Vector2d&)>& inside) {
  std::vector<LatticeCell> cells;
  for (int j = -2 * margin; j < rows + 2 * margin; ++j)
    for (int i = -margin; i < columns + margin; ++i)
      if (inside(middle_of(lattice, {i, j}, angle))) cells.push_back({i, j});
  return from_zero(largest_cells(lattice, angle, cells));
}

}  // namespace kinetix::model
