#pragma once

#include "model/closure/mobility.hpp"
#include "model/lattice/square/structure.hpp"

namespace kinetix::model {

/// The paper's description of one cell (Eq. 2, 5, 7): four walls counter-clockwise from the bottom-left corner. Edge
/// vectors follow that walk, so that the top and the left wall are opposite to the lattice direction.
struct CellTuple {
  std::array<double, 4> P = {0.5, 0.5, 0.5, 0.5};  ///< hinge positions, fractions of the wall, (0, 1)
  std::array<double, 4> A_in = {pi / 2, pi / 2, pi / 2, pi / 2};  ///< in-plane angles, rad, (0, pi)
  std::array<double, 4> A_out = {0, 0, 0, 0};                     ///< out-of-plane angles, rad, (-pi/2, pi/2)

  /// Returns the hinge parameters of wall k = 0..3 (bottom, right, top, left) in lattice direction.
  HingeParameters wall(int k) const;
};

/// Treatment of two neighbouring cells that disagree about their shared wall.
enum class SharedWalls { must_agree, average };

/// Gives every cell with i + j even the tuple `even`, every other cell `odd`.
/// @throws InvalidInput under must_agree, naming the first two cells that disagree by more than 1e-9
/// (of t, or rad).
void apply_pattern(Structure& structure, const CellTuple& even, const CellTuple& odd, SharedWalls shared);

/// Closed forms of the paper and of kinematics.md. Angles in rad. Every function throws InvalidInput for an
/// argument outside the range that its parameter states, NaN included.

/// Returns the area of a cell over its area at rest, with both pairs of walls divided at k: k^2 + (1-k)^2 + 2k(1-k)
/// cos(phi).
/// @param k fraction of a wall, [0, 1]   @param phi angle of the bars, twice the fold parameter, finite
double area_ratio(double k, double phi);

/// Eq. 3: area_ratio (dimensionless) at the last position of a crossable unit, phi = 135 deg:
/// (2 + sqrt 2) k^2 - (2 + sqrt 2) k + 1.   @param k in [0, 1] without 1/2
double final_area_ratio(double k);

/// Eq. 4: tan(shear angle) = (1 - k) / k, for the uncrossable unit with its bars on one line. The angle
/// between the cell's two sides is twice this.   @param k in (0, 1] without 1/2
double shear_angle(double k);

/// Returns the angle gamma between the two small cells of a twisted unit, Eq. 6: cot(gamma/2) = cot(alpha) sin(45
/// deg).
/// @param alpha in-plane hinge angle, (0, pi)   @return in (0, 2 pi), pi for the flat unit
double twist_angle(double alpha);

/// The two bending units of Eq. 8.
enum class BendUnit {
  B,  ///< A_out = (m, -n, m, -n)
  C,  ///< A_out = (m, n, m, n)
};

/// Returns the cell of Eq. 8.   @param beta_m, beta_n tilts, rad, (-pi/2, pi/2)
CellTuple bend_unit(BendUnit variant, double beta_m, double beta_n);

/// Returns the tilt v of one pair of hinge axes in its plane of symmetry while the other pair is tilted by u. The
/// unit is doubly mirrored, of either variant: cos(u) cos(v) = cos(beta_m) cos(beta_n).
/// @param beta_m, beta_n in (-pi/2, pi/2)   @param u with cos(u) >= cos(beta_m) cos(beta_n)
/// @return |v|, [0, pi/2)
double mirrored_unit_tilt(double beta_m, double beta_n, double u);

/// Returns the angle 2 psi by which a bending column folds the sheet: tan(psi) = tan(beta) sin(theta).
/// @param beta tilt of the column, rad, (-pi/2, pi/2)   @param theta fold parameter, [-pi/2, pi/2]
double crease_fold(double beta, double theta);

/// Returns the tilt that folds by `fold` at `theta`: the inverse of crease_fold.
/// @param fold rad, in (-pi, pi)   @param theta in [-pi/2, pi/2] without 0
double crease_tilt(double fold, double theta);

}  // namespace kinetix::model
