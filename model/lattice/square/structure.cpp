#include "model/lattice/square/structure.hpp"

#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>

#include "model/base/invalid_input.hpp"

namespace kinetix::model {
namespace {

// Cells: a mistyped size results in a message before memory runs out.
constexpr std::size_t max_cells = 1'000'000;
// Vertices: the limit also rejects few cells that are far apart, because exact families are computed on the whole
// lattice.
constexpr std::int64_t max_lattice_vertices = 4'000'000;

std::array<Vertex, 4> corners(const Cell& c) {
  return {Vertex{c.i, c.j}, {c.i + 1, c.j}, {c.i + 1, c.j + 1}, {c.i, c.j + 1}};
}

std::array<Wall, 4> walls(const Cell& c) {
  return {
      Wall{{c.i, c.j}, Axis::x}, {{c.i + 1, c.j}, Axis::y}, {{c.i, c.j + 1}, Axis::x}, {{c.i, c.j}, Axis::y}};
}

std::string pair(int i, int j) { return "[" + std::to_string(i) + ", " + std::to_string(j) + "]"; }

void check_walls(const CellSize& size) {
  if (!(size.edge_mm > 0) || !std::isfinite(size.edge_mm))
    throw InvalidInput("cell edge must be a positive length in mm");
  if (!(size.thickness_mm > 0) || !(size.thickness_mm < size.edge_mm / 2))
    throw InvalidInput("wall thickness must be positive and below half the cell edge");
  if (!(size.height_mm > 0) || !std::isfinite(size.height_mm))
    throw InvalidInput("wall height must be a positive length in mm");
}

void check_bounding_box(const std::vector<Cell>& cells) {
  std::int64_t columns = 0, rows = 0;
  for (const Cell& c : cells) {
    columns = std::max(columns, std::int64_t{c.i} + 1);
    rows = std::max(rows, std::int64_t{c.j} + 1);
  }
  if (columns >= max_lattice_vertices || rows >= max_lattice_vertices ||
      (columns + 1) * (rows + 1) > max_lattice_vertices)
    throw InvalidInput("the cells span " + std::to_string(columns) + " x " + std::to_string(rows) +
                       " from [0, 0]. Give cells whose lattice has at most 4 million vertices");
}

void check_cells(const std::vector<Cell>& cells) {
  if (cells.empty()) throw InvalidInput("a structure needs at least one cell");
  if (cells.size() > max_cells) throw InvalidInput("more than a million cells");
  for (const Cell& c : cells)
    if (c.i < 0 || c.j < 0)
      throw InvalidInput("cell " + to_string(c) + " has a negative index. Give indices from [0, 0]");
  check_bounding_box(cells);
  const auto twice = std::adjacent_find(cells.begin(), cells.end());
  if (twice != cells.end()) throw InvalidInput("cell " + to_string(*twice) + " is given twice");
}

void check_connected(const Structure& s) {
  std::vector<int> parent(s.bodies.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int b) {
    while (parent[b] != b) b = parent[b] = parent[parent[b]];
    return b;
  };
  for (const Hinge& h : s.hinges) parent[root(h.lower)] = root(h.upper);
  for (std::size_t c = 0; c < s.cells.size(); ++c)
    if (root(s.cell_members[c].bodies[0]) != root(0))
      throw InvalidInput("cell " + to_string(s.cells[c]) + " does not hang together with cell " +
                         to_string(s.cells[0]));
}

void check_between(const Hinge& hinge, const char* name, double value, double low, double high,
                   const char* allowed) {
  if (value > low && value < high) return;
  require(name + (" of the hinge on wall " + to_string(hinge.wall)), value, false,
          std::string("in ") + allowed);
}

}  // namespace

std::string to_string(Vertex v) { return pair(v.i, v.j); }

std::string to_string(const Cell& c) { return pair(c.i, c.j); }

std::string to_string(const Wall& wall) {
  return "[" + to_string(wall.from) + ", " + to_string(wall.to()) + "]";
}

std::string line_name(const Wall& wall, bool in_strip) {
  return in_strip || wall.axis == Axis::x ? "column " + std::to_string(wall.from.i)
                                          : "row " + std::to_string(wall.from.j);
}

std::vector<int> label(Vertex v) { return {v.i, v.j}; }

std::vector<int> label(const Cell& c) { return {c.i, c.j}; }

Eigen::Vector3d rest_place(Vertex v) { return {static_cast<double>(v.i), static_cast<double>(v.j), 0.0}; }

void check_extent(int columns, int rows) {
  require("columns", columns, columns >= 1, "at least 1");
  require("rows", rows, rows >= 1, "at least 1");
  if (static_cast<std::size_t>(columns) * rows > max_cells) throw InvalidInput("more than a million cells");
}

std::vector<Cell> rectangle(int columns, int rows) {
  check_extent(columns, rows);
  std::vector<Cell> cells;
  cells.reserve(static_cast<std::size_t>(columns) * rows);
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) cells.push_back({i, j});
  return cells;
}

Structure make_structure(std::vector<Cell> cells, const CellSize& size) {
  check_walls(size);
  std::sort(cells.begin(), cells.end());
  check_cells(cells);

  Structure s{size, std::move(cells), {}, {}, {}};
  s.bodies.reserve(4 * s.cells.size());
  for (const Cell& c : s.cells)
    for (const Vertex& v : corners(c)) s.bodies.push_back(v);
  std::sort(s.bodies.begin(), s.bodies.end());
  s.bodies.erase(std::unique(s.bodies.begin(), s.bodies.end()), s.bodies.end());

  s.cell_members.reserve(s.cells.size());
  // The cells below and to the left come first and already have the shared walls.
  const auto shared = [&](Cell cell, int side) -> std::optional<int> {
    const auto end = s.cells.begin() + static_cast<std::ptrdiff_t>(s.cell_members.size());
    const auto it = std::lower_bound(s.cells.begin(), end, cell);
    if (it == end || *it != cell) return std::nullopt;
    return s.cell_members[it - s.cells.begin()].hinges[side];
  };
  for (const Cell& c : s.cells) {
    CellHinges members{};
    const auto vertices = corners(c);
    const auto edges = walls(c);
    const std::array<std::optional<int>, 4> known = {shared({c.i, c.j - 1}, 2), std::nullopt, std::nullopt,
                                                     shared({c.i - 1, c.j}, 1)};
    for (int k = 0; k < 4; ++k) {
      members.bodies[k] = *s.body_at(vertices[k]);
      members.hinges[k] = known[k].value_or(static_cast<int>(s.hinges.size()));
      if (!known[k]) s.hinges.push_back({edges[k], *s.body_at(edges[k].from), *s.body_at(edges[k].to()), {}});
    }
    s.cell_members.push_back(members);
  }
  check_connected(s);
  return s;
}

Structure make_sheet(int columns, int rows, const CellSize& size) {
  return make_structure(rectangle(columns, rows), size);
}

std::vector<int> body_label(const Structure& structure, int body) { return label(structure.bodies[body]); }

std::vector<int> cell_label(const Structure& structure, int cell) { return label(structure.cells[cell]); }

std::optional<int> Structure::body_at(Vertex v) const {
  const auto it = std::lower_bound(bodies.begin(), bodies.end(), v);
  if (it == bodies.end() || *it != v) return std::nullopt;
  return static_cast<int>(it - bodies.begin());
}

std::optional<int> Structure::hinge_at(const Wall& wall) const {
  const Vertex v = wall.from;
  const bool along_x = wall.axis == Axis::x;
  const std::array<std::pair<Cell, int>, 2> sides = {
      std::pair{Cell{v.i, v.j}, along_x ? 0 : 3},
      std::pair{along_x ? Cell{v.i, v.j - 1} : Cell{v.i - 1, v.j}, along_x ? 2 : 1}};
  for (const auto& [cell, side] : sides) {
    const auto it = std::lower_bound(cells.begin(), cells.end(), cell);
    if (it != cells.end() && *it == cell) return cell_members[it - cells.begin()].hinges[side];
  }
  return std::nullopt;
}

Eigen::Vector3d Structure::rest_position(int body) const {
  return {bodies[body].i * size.edge_mm, bodies[body].j * size.edge_mm, 0.0};
}

Eigen::Vector3d Structure::hinge_point(const Hinge& hinge) const {
  return rest_position(hinge.lower) + size.edge_mm * rest_hinge(hinge).lower_arm;
}

void validate_hinges(const Structure& structure) {
  for (const Hinge& hinge : structure.hinges) {
    const HingeParameters& p = hinge.parameters;
    check_between(hinge, "t", p.t, 0, 1, "(0, 1)");
    check_between(hinge, "alpha", p.alpha, 0, pi, "(0, pi)");
    check_between(hinge, "beta", p.beta, -pi / 2, pi / 2, "(-pi/2, pi/2)");
    check_between(hinge, "offset", p.offset, -0.5, 0.5, "(-0.5, 0.5) cell edges");
  }
}

Eigen::Vector3d wall_up(Axis axis, double beta) { return wall_up(edge_direction(axis), beta); }

Eigen::Vector3d hinge_axis(Axis axis, const HingeParameters& p) {
  return hinge_axis(edge_direction(axis), p);
}

bool is_vertical(const Hinge& hinge) { return is_vertical(hinge_axis(hinge.wall.axis, hinge.parameters)); }

bool all_vertical(const Structure& structure) {
  return std::all_of(structure.hinges.begin(), structure.hinges.end(),
                     [](const Hinge& hinge) { return is_vertical(hinge); });
}

namespace {

/// Names of hinges and bodies in messages.
struct Names {
  std::vector<Wall> walls;
  std::vector<Vertex> vertices;
};

void name_parts(const Structure& s, Linkage& linkage) {
  auto names = std::make_shared<Names>();
  names->vertices = s.bodies;
  names->walls.reserve(s.hinges.size());
  for (const Hinge& hinge : s.hinges) names->walls.push_back(hinge.wall);
  linkage.wall_name = [names](int hinge) { return to_string(names->walls[hinge]); };
  linkage.vertex_name = [names](int body) { return to_string(names->vertices[body]); };
}

}  // namespace

HingedWall hinged_wall(const Hinge& hinge) {
  return {hinge.lower, hinge.upper, edge_direction(hinge.wall.axis), hinge.parameters};
}

RestHinge rest_hinge(const Hinge& hinge) { return rest_hinge(hinged_wall(hinge)); }

Structure::operator Linkage() const {
  Linkage out;
  out.size = size;
  out.bodies.reserve(bodies.size());
  for (const Vertex& v : bodies) out.bodies.push_back({rest_place(v), v.sense()});
  out.hinges.reserve(hinges.size());
  out.plates.reserve(2 * hinges.size());
  for (const Hinge& hinge : hinges) {
    for (const Plate& plate : plates(hinged_wall(hinge), static_cast<int>(out.hinges.size())))
      out.plates.push_back(plate);
    out.hinges.push_back(rest_hinge(hinge));
  }
  out.cells.reserve(cell_members.size());
  for (const CellHinges& cell : cell_members)
    out.cells.push_back({{cell.bodies.begin(), cell.bodies.end()}, {cell.hinges.begin(), cell.hinges.end()}});
  name_parts(*this, out);
  return out;
}

int line_of(const Wall& wall) { return row_along(wall.axis, wall.from); }

int line_count(const Structure& structure, Axis axis) {
  int count = 0;
  for (const Hinge& h : structure.hinges)
    if (h.wall.axis == axis) count = std::max(count, line_of(h.wall) + 1);
  return count;
}

std::vector<int> hinges_on_line(const Structure& structure, Axis axis, int line) {
  std::vector<int> hinges;
  for (int k = 0; k < static_cast<int>(structure.hinges.size()); ++k) {
    const Wall& wall = structure.hinges[k].wall;
    if (wall.axis == axis && line_of(wall) == line) hinges.push_back(k);
  }
  return hinges;
}

bool starts_in_sublattice_b(const Wall& wall) { return !wall.from.is_in_sublattice_a(); }

std::vector<std::vector<int>> body_columns(const Structure& structure) {
  std::vector<std::vector<int>> columns;
  for (int b = 0; b < static_cast<int>(structure.bodies.size()); ++b) {
    if (b == 0 || structure.bodies[b].i != structure.bodies[b - 1].i) columns.emplace_back();
    columns.back().push_back(b);
  }
  return columns;
}

}  // namespace kinetix::model
