#pragma once

#include <algorithm>
#include <cmath>

namespace kinetix::model {

/// The crease law (kinematics.md section 6), which holds for every lattice. It describes hinges in a row
/// whose axes lean by +-tilt along the row. They fold the sheet about the row by `turn`, tan(turn / 2) =
/// tan(tilt) sin(theta), while its bodies turn by +-theta in their panels. All angles rad.

/// Returns the turn of a crease of tilt beta at fold angle theta. @pre abs(tilt) < pi/2
inline double crease_turn(double tilt, double theta) {
  return 2 * std::atan(std::tan(tilt) * std::sin(theta));
}

/// Returns the tilt that folds by `turn` at theta. @pre 0 < abs(theta) < pi, abs(turn) < pi
inline double tilt_of_turn(double turn, double theta) {
  return std::atan(std::tan(turn / 2) / std::sin(theta));
}

/// Returns the theta in [0, pi/2] at which a crease of `tilt` folds by `turn`; pi/2 if it never does.
/// @pre 0 <= turn < pi, 0 < tilt < pi/2
inline double theta_of_turn(double turn, double tilt) {
  return std::asin(std::min(std::tan(turn / 2) / std::tan(tilt), 1.0));
}

/// Derivatives of crease_turn() by tilt and by theta, rad per rad.
struct CreaseDerivatives {
  double by_tilt = 0, by_theta = 0;
};

inline CreaseDerivatives crease_derivatives(double tilt, double theta) {
  const double s = std::sin(theta), tangent = std::tan(tilt);
  const double slope = 2 / (1 + tangent * tangent * s * s);
  return {slope * s * (1 + tangent * tangent), slope * tangent * std::cos(theta)};
}

}  // namespace kinetix::model
