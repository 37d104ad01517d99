#pragma once

#include <vector>

#include "model/lattice/square/crease.hpp"

namespace kinetix::model {

/// The fold angle of every crease of a net, where creases may cross (family F4,
/// model/lattice/square/family/net.hpp).
///
/// Take a cell of t = 1/2, alpha = 90 deg whose x-walls are of a crease of tilt b and whose y-walls of one of
/// tilt g. Its four bodies are mirror images of each other in two planes at right angles, each of which holds
/// the axes of two opposite hinges. With X and Y half the turns of its x-hinges and y-hinges (both theta
/// where b = g = 0) the normals of the planes are, as the lower left body sees them where it is of class A,
///     p = (cos X, -cos b sin X, -sin b sin X), q = (cos g sin Y, cos Y, -sin g sin Y), and p . q = 0 says
///     cot X / cos b = cot Y / cos g - tan b tan g.
/// So crease k moves as in a net without crossings, cot X = cos b cot theta_k, with a fold angle of its own,
///     cot theta_k = cot theta + c_k,   c of x-walls = c of y-walls - tan b tan g in every cell.
/// c is the crease's *shift*. It is 0 where no crease that bends crosses another. The equations have a
/// solution on a sheet without holes iff in every block of 2 x 2 cells the two columns or the two rows have
/// one tilt: going round the block they ask for (tan b - tan b') (tan g - tan g') = 0. Families F2 (g = 0)
/// and F3 (all g alike) are the rectangles of this kind; a row of single cells may have any tilts.

/// Cells that lead from crease to crease, so that every shift follows from another one's: a spanning forest
/// of the equations above. The shift of the y-walls of the first cell of each part that hangs together by
/// walls is 0: there theta is that of kinematics.md.
struct FoldAngleTree {
  struct Step {
    int crease = 0;   ///< whose shift follows, index in Creases::list
    int from = 0;     ///< from that of this crease
    int x_hinge = 0;  ///< walls of the cell in which they meet
    int y_hinge = 0;
    int sign = 0;  ///< of tan b tan g: -1 onto the crease of x-walls, +1 onto that of y-walls
  };
  std::size_t creases = 0;
  std::vector<Step> steps;  ///< one a crease, but for the first of each part; what leads on comes later
};

FoldAngleTree make_fold_angle_tree(const Structure& structure, const Creases& creases);

/// The shift of every crease, dimensionless, for the tilts that the structure has now. Exactly 0 where none
/// is.
/// @pre the tree is of this structure
std::vector<double> fold_shifts(const FoldAngleTree& tree, const Structure& structure);

/// Their derivatives by the tilt of one crease, per rad: of the tilt by alternation, as set_tilt takes it.
std::vector<double> fold_shift_gradient(const FoldAngleTree& tree, const Structure& structure, int crease);

/// A crease's fold angle with its derivatives.
struct FoldAngle {
  double value = 0;     ///< rad, in (-pi, pi); exactly theta where the shift is 0
  double by_theta = 1;  ///< rad per rad, > 0
  double by_shift = 0;  ///< rad per unit of the shift, which is dimensionless
};

/// cot(value) = cot(theta) + shift, by continuity 0 at theta = 0. Angles in rad. @pre abs(theta) < pi
FoldAngle fold_angle(double theta, double shift);

/// Half the turn X of a hinge of tilt b whose crease has this fold angle: cot(X) = cos(b) cot(angle), rad.
/// The upper body is turned against the lower one by -2 X where the lower one is class A, else by 2 X.
double half_turn(double tilt, double angle);

}  // namespace kinetix::model
