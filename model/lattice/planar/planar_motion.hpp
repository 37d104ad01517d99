#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "model/lattice/planar/planar_structure.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::model {

/// A second drawing of a graph, y, that says how its structure moves: X(theta) = cos(theta) x + i sin(theta)
/// y, with x the graph's own vertices and i the turn by 90 deg (kinematics.md section 5). Any y is the exact
/// motion of exactly one choice of hinge points: with e an edge from class A to class B and y_B - y_A = (s +
/// 2 i o) e, its hinge sits at t = (1 + s) / 2 from A and o |e| across. Cell edges.
using Redrawing = std::vector<Eigen::Vector2d>;

/// What y does to a wall, whichever way it is walked.
struct WallChange {
  /// 2 t_A - 1 with t_A the hinge's fraction from class A: it turns by atan(s tan(theta)) (where o = 0).
  double s = 0;
  /// Offset over the wall's length, towards z x e of the edge from class A to class B: the wall scales by
  /// cos(theta) - 2 o sin(theta).
  double o = 0;
};

/// y_to - y_from of an edge with this hinge, cell edges.
Eigen::Vector2d redrawn(const PlanarStructure& structure, int edge);
/// The sum of that along the loop round a face: 0 where the face closes.
Eigen::Vector2d redrawn_sum(const PlanarStructure& structure, const GraphFace& face);
WallChange change_of(const PlanarStructure& structure, const Redrawing& y, int edge);

/// The redrawing of a structure whose hinges are upright; y of the first vertex is 0. Where walking round a
/// face does not lead back, that face and by how much.
struct RedrawingFit {
  Redrawing y;
  double misfit = 0;    ///< of the worst face, cell edges
  double longest = 1;   ///< wall of that face, cell edges; 1 of faces with shorter walls
  int worst_face = -1;  ///< whose misfit over that is largest; -1 where no face has any

  /// Rounding of a sum over thousands of walls is below it; a hinge that is off by a nanometre is above.
  static constexpr double closed = 1e-11;  ///< cell edges; times the longest wall, where one is longer
  bool is_closed() const { return misfit <= closed * longest; }
};
RedrawingFit redrawing_of(const PlanarStructure& structure);

/// Puts the hinge of a wall where y has it; alpha and beta stay.
/// @param edge, redrawn of the wall in both drawings, from its first vertex to its second, cell edges
/// @param sense of the first vertex
void place_hinge(const Eigen::Vector2d& edge, const Eigen::Vector2d& redrawn, int sense,
                 HingeParameters& hinge);
/// Puts all of them there.
void place_hinges(const Redrawing& y, PlanarStructure& structure);

/// A vertex's place at theta in the cell edges of x and y, and its turn.
/// @param x, y of the vertex in both drawings, cell edges   @param sense +1 (class A) or -1
Pose redrawn_pose(const Eigen::Vector2d& x, const Eigen::Vector2d& y, int sense, double theta);

/// State at theta, mm. Class A turns by theta, class B by -theta.
State fold(const PlanarStructure& structure, const Redrawing& y, double theta);

/// The exact motion of upright hinges, or of facets of them that creases join (model/lattice/planar/creased_motion.hpp);
/// or why there is none.
ExactMotion exact_motion(const PlanarStructure& structure);

}  // namespace kinetix::model
