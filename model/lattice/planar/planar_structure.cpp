#include "model/lattice/planar/planar_structure.hpp"

#include <map>
#include <utility>

#include "model/base/algorithms.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::model {
namespace {

void check(const PlanarStructure& s, int hinge, const char* name, double value, double low, double high,
           const char* allowed) {
  if (value > low && value < high) return;
  require(name + (" of the hinge on wall " + to_string(s.graph.edges[hinge])), value, false,
          std::string("in ") + allowed);
}

// Steps per wall length by which middles are distinguished: cells are farther apart
constexpr double middles_per_wall = 100;

/// Returns the middle of a polygon's corners in such steps, to one step of rounding.
std::pair<long, long> middle_of(const std::vector<Eigen::Vector2d>& corners) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : corners) sum += corner;
  sum *= middles_per_wall / static_cast<double>(corners.size());
  return {std::lround(sum.x()), std::lround(sum.y())};
}

/// Returns the faces with the cells of the sheet first, in their order.
std::vector<GraphFace> cells_first(const PlanarGraph& graph, std::vector<GraphFace> faces,
                                   const LatticeSheet& sheet) {
  std::map<std::pair<long, long>, int> cell_at;
  for (const auto& [i, j] : sheet.cells) {
    const auto middle = middle_of(sheet.lattice->corners(i, j, sheet.angle));
    if (!cell_at.try_emplace(middle, static_cast<int>(cell_at.size())).second)
      throw InvalidInput("cell [" + std::to_string(i) + ", " + std::to_string(j) + "] is given twice");
  }
  const auto rank = [&](const GraphFace& face) {
    std::vector<Eigen::Vector2d> corners;
    for (const int v : face.vertices) corners.push_back(graph.vertices[v]);
    const auto [x, y] = middle_of(corners);
    for (const long i : {x - 1, x, x + 1})
      for (const long j : {y - 1, y, y + 1})
        if (const auto cell = cell_at.find({i, j}); cell != cell_at.end()) return cell->second;
    return static_cast<int>(cell_at.size());
  };
  std::vector<std::pair<int, int>> order;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f) order.emplace_back(rank(faces[f]), f);
  std::sort(order.begin(), order.end());
  std::vector<GraphFace> sorted;
  for (const auto& [cell, f] : order) sorted.push_back(std::move(faces[f]));
  return sorted;
}

void check_hang_together(const PlanarStructure& s, const std::vector<LatticeCell>& cells) {
  UnionFind pieces(s.faces.size());
  std::vector<int> face_at(s.graph.edges.size(), -1);
  for (int f = 0; f < static_cast<int>(s.faces.size()); ++f)
    for (const int e : s.faces[f].edges) {
      if (face_at[e] >= 0) pieces.unite(face_at[e], f);
      face_at[e] = f;
    }
  const auto name = [&](std::size_t c) {
    return "[" + std::to_string(cells[c][0]) + ", " + std::to_string(cells[c][1]) + "]";
  };
  for (std::size_t c = 1; c < cells.size(); ++c)
    if (pieces.find(static_cast<int>(c)) != pieces.find(0))
      throw InvalidInput("cells " + name(0) + " and " + name(c) +
                         " are not connected by a wall. Connect them: at a single vertex they can turn "
                         "relative to each other");
}

}  // namespace

PlanarStructure make_planar_structure(PlanarGraph graph, const CellSize& size) {
  check_lengths(size);
  validate(graph);
  PlanarStructure s;
  s.size = size;
  s.graph = std::move(graph);
  s.faces = bounded_faces(s.graph);
  s.senses = senses(s.graph, s.faces);
  s.hinges.resize(s.graph.edges.size());
  return s;
}

PlanarStructure make_planar_structure(LatticeSheet sheet, const CellSize& size) {
  if (sheet.cells.empty()) throw InvalidInput("a sheet needs at least one cell");
  PlanarStructure s = make_planar_structure(lattice_graph(sheet), size);
  s.faces = cells_first(s.graph, std::move(s.faces), sheet);
  check_hang_together(s, sheet.cells);
  s.drawn = std::move(sheet);
  return s;
}

HingedWall hinged_wall(const PlanarStructure& s, int hinge) {
  const Eigen::Vector2d edge = s.graph.along(hinge);
  return {s.graph.edges[hinge].from, s.graph.edges[hinge].to, {edge.x(), edge.y(), 0}, s.hinges[hinge]};
}

void validate_hinges(const PlanarStructure& s) {
  for (int h = 0; h < static_cast<int>(s.hinges.size()); ++h) {
    const auto& [t, alpha, beta, offset] = s.hinges[h];
    check(s, h, "t", t, 0, 1, "(0, 1)");
    check(s, h, "alpha", alpha, 0, pi, "(0, pi) rad");
    check(s, h, "beta", beta, -pi / 2, pi / 2, "(-pi/2, pi/2) rad");
    const double half = s.graph.along(h).norm() / 2;
    check(s, h, "offset", offset, -half, half, "half the wall's length to either side");
  }
}

PlanarStructure::operator Linkage() const {
  Linkage out;
  out.size = size;
  for (std::size_t v = 0; v < graph.vertices.size(); ++v)
    out.bodies.push_back({{graph.vertices[v].x(), graph.vertices[v].y(), 0}, senses[v]});
  for (int h = 0; h < static_cast<int>(hinges.size()); ++h) {
    const HingedWall wall = hinged_wall(*this, h);
    out.hinges.push_back(rest_hinge(wall));
    for (const Plate& plate : plates(wall, h)) out.plates.push_back(plate);
  }
  for (const GraphFace& face : faces) out.cells.push_back({face.vertices, face.edges});
  out.wall_name = [edges = graph.edges](int hinge) { return to_string(edges[hinge]); };
  out.vertex_name = [](int body) { return std::to_string(body); };
  return out;
}

}  // namespace kinetix::model
