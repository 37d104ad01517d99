#pragma once

#include <vector>

#include "model/linkage/linkage.hpp"

namespace kinetix::model {

/// How a hinge turns along an exact motion: by 2 X from flat, cot(X) = p cot(theta) + q, X = 0 at theta = 0. Upright hinges
/// have p = 1: they turn by 2 theta. Hinges of a crease whose axes lean by beta from upright have p = cos(beta): the two
/// turns by theta within their panels and the fold between, of the crease law (kinematics.md section 2), are one turn about
/// the axis. Where creases cross, q = shift cos(beta) (model/lattice/square/family/fold_angles.hpp).
struct TurnLaw {
  double p = 1;  ///< > 0, ratio
  double q = 0;  ///< ratio

  /// 2 X, rad. @pre abs(theta) < pi
  double turn(double theta) const;
  /// Its derivative, rad per rad: 2 p / f, f = sin(theta)^2 + (p cos(theta) + q sin(theta))^2 > 0.
  double rate(double theta) const;
};

/// What a rate never exceeds over an interval of theta.
struct RateBounds {
  double rate = 0;    ///< of the turn, rad per rad
  double change = 0;  ///< of its derivative, rad per rad^2, without sign
};

/// Since f = m + r cos(2 theta - phi), its least value over an interval is at an end or where the cosine is -1.
/// @pre low <= high, rad
RateBounds bounds_of(const TurnLaw& law, double low, double high);

/// The law of every hinge where creases do not cross: by the tilt of its axis at rest; 2 theta in lattices in space, whose
/// rotors turn against gussets that do not turn.
std::vector<TurnLaw> usual_turn_laws(const Linkage& linkage);

/// +1 or -1: which way the upper body of a hinge turns against the lower one about the axis as theta grows.
int hinge_sense(const Linkage& linkage, int hinge);

}  // namespace kinetix::model
