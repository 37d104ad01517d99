#include "model/lattice/planar/planar_structure.hpp"

#include <cmath>
#include <utility>

#include "model/base/invalid_input.hpp"
#include "model/linkage/wall.hpp"

namespace kinetix::model {
namespace {

/// From the first vertex of its edge.
HingedWall hinged_wall(const PlanarStructure& s, int index) {
  const Eigen::Vector2d edge = s.graph.along(index);
  return {s.graph.edges[index].from, s.graph.edges[index].to, {edge.x(), edge.y(), 0}, s.hinges[index]};
}

void check(const PlanarStructure& s, int hinge, const char* name, double value, double low, double high,
           const char* allowed) {
  if (value > low && value < high) return;
  throw InvalidInput(std::string(name) + " of the hinge on wall " + to_string(s.graph.edges[hinge]) + " is " +
                     number_text(value) + ", must be in " + allowed);
}

void check_size(const CellSize& size) {
  for (const auto& [name, value] :
       {std::pair("cell edge", size.edge_mm), std::pair("wall thickness", size.thickness_mm),
        std::pair("wall height", size.height_mm)})
    if (!(value > 0) || !std::isfinite(value))
      throw InvalidInput(std::string(name) + " must be a positive length in mm");
}

}  // namespace

PlanarStructure make_planar_structure(PlanarGraph graph, const CellSize& size) {
  check_size(size);
  validate(graph);
  PlanarStructure s;
  s.size = size;
  s.graph = std::move(graph);
  s.faces = bounded_faces(s.graph);
  s.senses = senses(s.graph, s.faces);
  s.hinges.resize(s.graph.edges.size());
  return s;
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
