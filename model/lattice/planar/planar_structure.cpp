#include "model/lattice/planar/planar_structure.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "model/base/invalid_input.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

/// Unit vectors at a wall: along it, across it (z x e), and up its plate.
struct WallFrame {
  Vector3d along, across;

  explicit WallFrame(const Eigen::Vector2d& edge)
      : along(edge.x(), edge.y(), 0), across(-edge.y(), edge.x(), 0) {
    along.normalize();
    across.normalize();
  }
  /// cos(beta) z + sin(beta) (e x z)
  Vector3d up(double beta) const { return std::cos(beta) * Vector3d::UnitZ() - std::sin(beta) * across; }
};

RestHinge rest_hinge(const PlanarStructure& s, int index) {
  const auto& [t, alpha, beta, offset] = s.hinges[index];
  const Eigen::Vector2d edge = s.graph.along(index);
  const WallFrame frame(edge);
  RestHinge out;
  out.lower = s.graph.edges[index].from;
  out.upper = s.graph.edges[index].to;
  out.edge = {edge.x(), edge.y(), 0};
  out.lower_arm = t * out.edge + offset * frame.across;
  out.upper_arm = (t - 1) * out.edge + offset * frame.across;
  out.axis = std::cos(alpha) * frame.along + std::sin(alpha) * frame.up(beta);
  out.axis_alpha = -std::sin(alpha) * frame.along + std::cos(alpha) * frame.up(beta);
  out.axis_beta = std::sin(alpha) * frame.up(beta + pi / 2);
  return out;
}

/// Both plates of a wall: that of the first body, then that of the second one.
void add_plates(const PlanarStructure& s, int index, std::vector<Plate>& plates) {
  const auto& [t, alpha, beta, offset] = s.hinges[index];
  const WallFrame frame(s.graph.along(index));
  const double length = s.graph.along(index).norm();
  for (const double side : {1.0, -1.0}) {
    Plate plate;
    plate.body = side > 0 ? s.graph.edges[index].from : s.graph.edges[index].to;
    plate.hinge = index;
    plate.edge = side * frame.along;
    plate.up = frame.up(beta);
    plate.up_beta = frame.up(beta + pi / 2);
    plate.length = (side > 0 ? t : 1 - t) * length;
    plate.length_t = side * length;
    plate.slant = side * std::cos(alpha) / std::sin(alpha);
    plates.push_back(plate);
  }
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
    out.hinges.push_back(rest_hinge(*this, h));
    add_plates(*this, h, out.plates);
  }
  for (const GraphFace& face : faces) out.cells.push_back({face.vertices, face.edges});
  out.wall_name = [edges = graph.edges](int hinge) { return to_string(edges[hinge]); };
  out.vertex_name = [](int body) { return std::to_string(body); };
  return out;
}

}  // namespace kinetix::model
