#pragma once

#include "model/lattice/planar/planar_crease.hpp"

namespace kinetix::model {

/// Exact motion of a planar structure with creases (kinematics.md section 6). Each facet moves in its plane as in the
/// structure without creases. It is then turned as a whole about the lines of the creases that lead to it.

/// Value of ExactMotion::name.
inline constexpr const char* creased_family = "creased";

/// Creases that lead from the facet of body 0 to every other facet, each after its parent.
struct FacetTree {
  struct Link {
    int facet = 0, parent = 0;
    int crease = 0;  ///< index in PlanarCreases::list
    int side = 1;    ///< 1 from the crease's `from` to its `to`, -1 in reverse
  };
  std::vector<Link> links;
};
FacetTree facet_tree(const PlanarCreases& creases);

/// Returns the motion of each facet as a whole, from the plane in which it moves without folds, mm.
std::vector<Eigen::Isometry3d> facet_frames(const PlanarStructure& structure, const ParallelDrawing& y,
                                            const PlanarCreases& creases, const FacetTree& tree,
                                            double theta);

/// Returns the state at theta, mm. The facet of body 0 stays in the plane z = 0.
/// @pre why_not_creased() is empty: otherwise hinges off the tree do not close
State fold(const PlanarStructure& structure, const ParallelDrawing& y, const PlanarCreases& creases,
           const FacetTree& tree, double theta);

/// Explains why the creases of a structure that moves exactly in its plane do not fold it exactly. The sentence names
/// walls or faces and amounts; it is empty if they do. The conditions are:
/// - Each crease runs from boundary to boundary, or to a face where it meets others.
/// - Its hinges have one lean and stay on its line.
/// - Creases meet only where the turns about all of them in sequence cancel, as for the four of a flat-foldable
/// vertex (kinematics.md section 6).
std::string why_not_creased(const PlanarStructure& structure, const ParallelDrawing& y,
                            const PlanarCreases& creases);

/// Returns the exact motion of structures with leaning hinges. @pre y is that of parallel_drawing_of(structure), and closes
ExactMotion creased_motion(const PlanarStructure& structure, const ParallelDrawing& y);

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
CreasePattern crease_pattern(const PlanarStructure& structure, const ParallelDrawing& y, double theta);

}  // namespace kinetix::model
