#include "model/lattice/square/family/planar_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/base/invalid_input.hpp"

namespace kinetix::model {
namespace {

Eigen::Vector2d place(Vertex v) { return rest_place(v).head<2>(); }

bool is_cell(const GraphFace& face, const Structure& sheet) {
  if (face.vertices.size() != 4) return false;
  const Vertex first = sheet.bodies[*std::min_element(face.vertices.begin(), face.vertices.end())];
  return std::binary_search(sheet.cells.begin(), sheet.cells.end(), Cell{first.i, first.j});
}

/// Names a face by the bodies at its lower left and upper right corner.
std::string name_of(const GraphFace& face, const Structure& sheet) {
  const auto [first, last] = std::minmax_element(face.vertices.begin(), face.vertices.end());
  return (is_cell(face, sheet) ? "the cell" : "the hole") + std::string(" from ") +
         to_string(sheet.bodies[*first]) + " to " + to_string(sheet.bodies[*last]);
}

}  // namespace

PlanarStructure planar_structure(const Structure& sheet) {
  PlanarStructure out;
  out.size = sheet.size;
  for (const Vertex& v : sheet.bodies) {
    out.graph.vertices.push_back(place(v));
    out.senses.push_back(v.sense());
  }
  for (const Hinge& hinge : sheet.hinges) {
    out.graph.edges.push_back({hinge.lower, hinge.upper});
    out.hinges.push_back(hinge.parameters);
  }
  for (const CellHinges& cell : sheet.cell_members)
    out.faces.push_back({{cell.bodies.begin(), cell.bodies.end()}, {cell.hinges.begin(), cell.hinges.end()}});
  for (GraphFace& face : bounded_faces(out.graph))
    if (!is_cell(face, sheet)) out.faces.push_back(std::move(face));
  return out;
}

PlanarSheet planar_motion(const Structure& sheet) {
  const PlanarStructure planar = planar_structure(sheet);
  RedrawingFit fit = redrawing_of(planar);
  if (fit.is_closed())
    return {std::move(fit.y), -1,
            "planar: all axes vertical, every face closes: each body on a path of its own"};
  const GraphFace& face = planar.faces[fit.worst_face];
  return {{},
          face.edges.front(),
          "no exact family: " + name_of(face, sheet) + " does not close: it is off by " +
              number_text(fit.misfit) + " cell edges times sin(theta)"};
}

void place_hinges(const Redrawing& y, Structure& sheet) {
  for (Hinge& hinge : sheet.hinges)
    place_hinge(edge_direction(hinge.wall.axis).head<2>(), y[hinge.upper] - y[hinge.lower],
                hinge.wall.from.sense(), hinge.parameters);
}

State fold(const Redrawing& y, const Structure& sheet, double theta) {
  State state(y.size());
  for (std::size_t b = 0; b < y.size(); ++b) {
    state[b] = redrawn_pose(place(sheet.bodies[b]), y[b], sheet.bodies[b].sense(), theta);
    state[b].p *= sheet.size.edge_mm;
  }
  return state;
}

}  // namespace kinetix::model
