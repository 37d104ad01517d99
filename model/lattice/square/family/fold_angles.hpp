#pragma once

#include "model/lattice/square/crease.hpp"

namespace kinetix::model {

/// Fold angles of the creases of a net, which may cross (family F4, model/lattice/square/family/net.hpp).
///
/// Consider a cell of t = 1/2, alpha = 90 deg with x-walls in a crease of tilt b and y-walls in a crease of tilt g.
/// Its four bodies are mirror images of each other in two planes at right angles. Each plane contains the axes of two
/// opposite hinges. X and Y are half the turns of its x-hinges and y-hinges (both theta if b = g = 0). The normals of
/// the planes, in the frame of a lower left body of sublattice A, are
///     p = (cos X, -cos b sin X, -sin b sin X), q = (cos g sin Y, cos Y, -sin g sin Y), and p . q = 0 gives
///     cot X / cos b = cot Y / cos g - tan b tan g.
/// So crease k moves as in a net without crossings, cot X = cos b cot theta_k, with its fold angle
///     cot theta_k = cot theta + c_k,   c of x-walls = c of y-walls - tan b tan g in every cell.
/// The term c is the crease's *shift*. It is 0 if no crease that bends crosses another. On a sheet without holes the
/// equations have a solution iff in every block of 2 x 2 cells the two columns or the two rows have one tilt. The sum
/// around the block requires (tan b - tan b') (tan g - tan g') = 0. Families F2 (g = 0) and F3 (all g equal) are the
/// rectangles of this kind. A row of single cells may have any tilts.

/// Cells that lead from crease to crease, so that every shift follows from another one: a spanning forest of the
/// equations above. In the first cell of each part that is connected by walls, the shift of the y-walls is 0. There
/// theta is that of kinematics.md.
struct FoldAngleTree {
  struct Step {
    int crease = 0;   ///< crease whose shift follows, index in Creases::list
    int from = 0;     ///< crease whose shift is known
    int x_hinge = 0;  ///< walls of the cell in which they meet
    int y_hinge = 0;
    int sign = 0;  ///< sign of tan b tan g: -1 onto the crease of x-walls, +1 onto that of y-walls
  };
  std::size_t creases = 0;
  std::vector<Step> steps;  ///< one per crease except the first of each part, in the order of dependence
};

FoldAngleTree make_fold_angle_tree(const Structure& structure, const Creases& creases);

/// Returns the shift of every crease, dimensionless, for the present tilts of the structure. It is exactly 0 if there
/// is no shift.
/// @pre the tree is of this structure
std::vector<double> fold_shifts(const FoldAngleTree& tree, const Structure& structure);

/// Returns the derivatives of the shifts by the tilt of one crease, per rad. The tilt alternates as in set_tilt.
std::vector<double> fold_shift_gradient(const FoldAngleTree& tree, const Structure& structure, int crease);

/// Fold angle of a crease with its derivatives.
struct FoldAngle {
  double value = 0;     ///< rad, in (-pi, pi); exactly theta where the shift is 0
  double by_theta = 1;  ///< rad per rad, > 0
  double by_shift = 0;  ///< rad per unit of the shift, which is dimensionless
};

/// Returns the solution of cot(value) = cot(theta) + shift, continuous and 0 at theta = 0. Angles in rad. @pre
/// abs(theta) < pi
FoldAngle fold_angle(double theta, double shift);

/// Returns half the turn, X, of a hinge of tilt b whose crease has this fold angle: cot(X) = cos(b) cot(angle), rad.
/// The upper body turns relative to the lower one by -2 X if the lower one is of sublattice A, otherwise by 2 X.
double half_turn(double tilt, double angle);

}  // namespace kinetix::model
