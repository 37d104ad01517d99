#include <memory>

#include "model/lattice/square/structure.hpp"
#include "model/linkage/wall.hpp"

namespace kinetix::model {
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

}  // namespace kinetix::model
