#pragma once

#include <vector>

#include "model/lattice/planar/creased_motion.hpp"

namespace kinetix::model {

/// Facets of a creased sheet as polygons: what its bodies and walls stand on. Rims run through the outermost bodies.
struct CreasePattern {
  struct Edge {
    int from = 0, to = 0;  ///< vertices
    int crease = -1;       ///< index in PlanarCreases::list; -1 at the rim
    double multiplier =
        0;  ///< dimensionless: tangent of the tilt, positive where the facets rise; 0 at the rim
  };
  std::vector<Eigen::Vector2d> flat;    ///< of each vertex, mm
  std::vector<Eigen::Vector3d> folded;  ///< mm at theta; the facet of body 0 stays in the plane z = 0
  std::vector<Edge> edges;
  std::vector<std::vector<int>> facets;  ///< of the sheet, in their order: vertices, counter-clockwise
};

/// @param theta rad   @pre creased_motion(structure, y) knows a motion
/// @throws InvalidInput for a sheet whose facets are no polygons: with a wall that stands out alone, a hole that facets
/// surround, or a crease of a single hinge on a bridge
CreasePattern crease_pattern(const PlanarStructure& structure, const Redrawing& y, double theta);

}  // namespace kinetix::model
