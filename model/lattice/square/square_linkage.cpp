#include <cmath>
#include <memory>

#include "model/lattice/square/structure.hpp"

namespace kinetix::model {
namespace {

/// Both plates of a wall: that of the lower body, then that of the upper one.
void add_plates(const Hinge& hinge, int index, std::vector<Plate>& plates) {
  const auto& [t, alpha, beta] = hinge.parameters;
  Plate plate;
  plate.body = hinge.lower;
  plate.hinge = index;
  plate.edge = edge_direction(hinge.wall.axis);
  plate.up = wall_up(hinge.wall.axis, beta);
  plate.up_beta = wall_up(hinge.wall.axis, beta + pi / 2);
  plate.length = t;
  plate.length_t = 1;
  plate.slant = std::cos(alpha) / std::sin(alpha);
  plates.push_back(plate);
  plate.body = hinge.upper;
  plate.edge = -plate.edge;
  plate.length = 1 - t;
  plate.length_t = -1;
  plate.slant = -plate.slant;
  plates.push_back(plate);
}

/// What messages call hinges and bodies.
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

RestHinge rest_hinge(const Hinge& hinge) {
  const auto& [t, alpha, beta] = hinge.parameters;
  const Axis axis = hinge.wall.axis;
  RestHinge out;
  out.lower = hinge.lower;
  out.upper = hinge.upper;
  out.edge = edge_direction(axis);
  out.lower_arm = t * out.edge;
  out.upper_arm = (t - 1) * out.edge;
  out.axis = hinge_axis(axis, hinge.parameters);
  out.axis_alpha = -std::sin(alpha) * out.edge + std::cos(alpha) * wall_up(axis, beta);
  out.axis_beta = std::sin(alpha) * wall_up(axis, beta + pi / 2);
  return out;
}

Structure::operator Linkage() const {
  Linkage out;
  out.size = size;
  out.bodies.reserve(bodies.size());
  for (const Vertex& v : bodies) out.bodies.push_back({rest_place(v), v.sense()});
  out.hinges.reserve(hinges.size());
  out.plates.reserve(2 * hinges.size());
  for (const Hinge& hinge : hinges) {
    const int index = static_cast<int>(out.hinges.size());
    out.hinges.push_back(rest_hinge(hinge));
    add_plates(hinge, index, out.plates);
  }
  out.cells.reserve(cell_members.size());
  for (const CellHinges& cell : cell_members)
    out.cells.push_back({{cell.bodies.begin(), cell.bodies.end()}, {cell.hinges.begin(), cell.hinges.end()}});
  name_parts(*this, out);
  return out;
}

}  // namespace kinetix::model
