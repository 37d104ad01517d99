#pragma once

#include <vector>

#include "model/lattice/planar/creased_motion.hpp"

namespace kinetix::model {

/// Facets of a creased sheet as polygons. Boundaries run through the outermost bodies.
struct CreasePattern {
  struct Edge {
    int from = 0, to = 0;  ///< vertices
    int crease = -1;       ///< index in PlanarCreases::list; -1 at the boundary
    /// Tangent of the tilt, dimensionless, positive if the facets rise; 0 at the boundary
    double multiplier = 0;
  };
  std::vector<Eigen::Vector2d> flat;    ///< position of each vertex, mm
  std::vector<Eigen::Vector3d> folded;  ///< mm at theta; the facet of body 0 stays in the plane z = 0
  std::vector<Edge> edges;
  std::vector<std::vector<int>> facets;  ///< vertices of each facet, counter-clockwise, in the sheet's order
};

/// Computes the crease pattern at theta. @param theta rad   @pre creased_motion(structure, y) has a motion
/// @throws InvalidInput for a sheet whose facets are not polygons. Examples are a single projecting wall, a hole
/// enclosed by facets, or a crease of a single hinge on a bridge
CreasePattern crease_pattern(const PlanarStructure& structure, const Redrawing& y, double theta);

}  // namespace kinetix::model
