#pragma once

#include "model/lattice/planar/planar_structure.hpp"
#include "model/linkage/exact_motion.hpp"
#include "model/linkage/linkage_drive.hpp"

namespace kinetix::model {

/// A parallel drawing y of a graph, which defines the motion of its structure: X(theta) = cos(theta) x + i sin(theta)
/// y, with x the graph's vertices and i the turn by 90 deg (kinematics.md section 5). Any y is the exact motion of
/// exactly one choice of hinge points. With e an edge from sublattice A to B and y_B - y_A = (s + 2 i o) e, its hinge
/// is at t = (1 + s) / 2 from A and o |e| across. Cell edges.
using ParallelDrawing = std::vector<Eigen::Vector2d>;

/// Change of a wall by y, independent of its direction.
struct WallChange {
  /// 2 t_A - 1 with t_A the hinge's fraction from sublattice A: the wall turns by atan(s tan(theta)) (for o = 0).
  double s = 0;
  /// Offset over the wall's length, in the direction z x e of the edge from sublattice A to B: the wall scales by
  /// cos(theta) - 2 o sin(theta).
  double o = 0;
};

/// Returns y_to - y_from of an edge with this hinge, cell edges.
Eigen::Vector2d parallel_edge(const PlanarStructure& structure, int edge);
/// Returns the sum of redrawn() along the loop around a face: 0 if the face closes.
Eigen::Vector2d parallel_sum(const PlanarStructure& structure, const GraphFace& face);
WallChange change_of(const PlanarStructure& structure, const ParallelDrawing& y, int edge);

/// Parallel drawing of a structure whose hinges are upright; y of the first vertex is 0. If a walk around a face does
/// not close, that face and its misfit are included.
struct ParallelDrawingFit {
  ParallelDrawing y;
  double misfit = 0;    ///< misfit of the worst face, cell edges
  double longest = 1;   ///< longest wall of that face, cell edges; 1 for faces with shorter walls
  int worst_face = -1;  ///< face with the largest misfit over `longest`; -1 without any misfit.

  /// Above the rounding of a sum over thousands of walls, below the effect of a hinge that is off by a nanometre.
  /// Cell edges; times the longest wall of a face if that is longer than 1
  static constexpr double closed = 1e-11;
  bool is_closed() const { return misfit <= closed * longest; }
};
ParallelDrawingFit parallel_drawing_of(const PlanarStructure& structure);

/// Places the hinge of a wall by y; alpha and beta do not change.
/// @param edge, redrawn of the wall in both drawings, from its first vertex to its second, cell edges.
/// @param sense of the first vertex
void place_hinge(const Eigen::Vector2d& edge, const Eigen::Vector2d& parallel_edge, int sense,
                 HingeParameters& hinge);
/// Places all hinges by y.
void place_hinges(const ParallelDrawing& y, PlanarStructure& structure);

/// Returns a vertex's position at theta in the cell edges of x and y, and its turn.
/// @param x, y of the vertex in both drawings, cell edges   @param sense +1 (sublattice A) or -1
Pose parallel_pose(const Eigen::Vector2d& x, const Eigen::Vector2d& y, int sense, double theta);

/// Returns the state at theta, mm. Sublattice A turns by theta, B by -theta.
State fold(const PlanarStructure& structure, const ParallelDrawing& y, double theta);

/// Returns the exact motion of upright hinges, or of facets of them joined by creases
/// (model/lattice/planar/creased_motion.hpp). Otherwise it gives the reason why there is none.
ExactMotion exact_motion(const PlanarStructure& structure);

/// Drives of structures on planar graphs. Plates grip the bodies on the first and on the last line of vertices across
/// their axis: those with the least and the greatest rest position along it.

/// Returns the rows that plates grip. @throws InvalidInput if a row has a single body: it would let the panel turn
GrippedRows boundary_rows(const PlanarStructure& structure, Axis axis);

/// Creates two plates that close by `compression`, in [0, 1). @param branch 1 or -1, the sign of theta
/// @throws InvalidInput as boundary_rows, and for hinge parameters out of range
LinkageDrive plate_drive(const PlanarStructure& structure, Axis axis, double compression, int branch);
/// Creates a drive that turns the second body of a wall relative to the first one. @param angle rad, in (-pi, pi)
/// @throws InvalidInput for hinge parameters out of range
LinkageDrive hinge_drive(const PlanarStructure& structure, int hinge, double angle);
/// Returns plates along y, or else along x, whose lines stay straight in the exact motion and approach each other.
/// Otherwise, and without an exact motion, it returns the first upright hinge.
/// @param theta rad, in (-pi/2, pi/2). @throws InvalidInput for any other
LinkageDrive drive_to(const PlanarStructure& structure, double theta);

/// Returns true if rows of bodies that are straight across the axis at rest stay straight during the motion.
bool keeps_rows_straight(const ParallelDrawing& y, Axis axis, const GrippedRows& rows);
/// Rejects plates whose rows do not stay straight. @throws InvalidInput
void reject_curved_rows(const LinkageDrive& drive, const ParallelDrawing& y);

}  // namespace kinetix::model
