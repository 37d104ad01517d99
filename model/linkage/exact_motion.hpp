#pragma once

#include "model/linkage/linkage.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Values of theta, rad, at which a motion is tested for the properties it should keep: near flat, halfway
/// and far. A fit at one of them by chance is not a fit at all three.
inline constexpr double probe_thetas[] = {0.2, 0.5, 0.9};

/// Closed form of a linkage that moves exactly, from its lattice.
struct ExactMotion {
  std::function<State(double theta)> at;  ///< state, mm, at fold parameter theta, rad; empty if none is known
  std::string name;                       ///< name of the family
  std::string why;  ///< one sentence: the family's rule, or the reason why there is no closed form
  /// First theta from flat, rad, at which the motion reaches a drive's target. Set if `at` is set.
  /// @throws InvalidInput for a drive that the motion never meets, or that would block it earlier
  std::function<double(const LinkageDrive& drive)> theta_of = {};

  explicit operator bool() const { return static_cast<bool>(at); }
};

/// A linkage under a drive, with its closed form if there is one.
struct DrivenLinkage {
  Linkage linkage;
  LinkageDrive drive;
  ExactMotion exact;
};

/// Turn of a hinge along an exact motion: 2 X from flat, cot(X) = p cot(theta) + q, X = 0 at theta = 0.
/// Upright hinges have p = 1: they turn by 2 theta. Hinges of a crease whose axes lean by beta from upright
/// have p = cos(beta). One turn about their axis combines the two turns by theta within their panels and the
/// fold between them, of the crease law (kinematics.md section 2). For crossing creases, q = shift cos(beta)
/// (model/lattice/square/family/fold_angles.hpp).
struct TurnLaw {
  double p = 1;  ///< > 0, ratio
  double q = 0;  ///< ratio

  /// Returns 2 X, rad. @pre abs(theta) < pi
  double turn(double theta) const;
  /// Returns the derivative of the turn, rad per rad: 2 p / f, f = sin(theta)^2 + (p cos(theta) + q
  /// sin(theta))^2 > 0.
  double rate(double theta) const;
};

/// Upper bounds of a turn's rate over an interval of theta.
struct RateBounds {
  double rate = 0;    ///< bound of the turn's rate, rad per rad
  double change = 0;  ///< bound of the rate's absolute derivative, rad per rad^2
};

/// Computes the bounds over an interval. Since f = m + r cos(2 theta - phi), its least value is at an end or
/// where the cosine is -1.
/// @pre low <= high, rad
RateBounds bounds_of(const TurnLaw& law, double low, double high);

/// Returns the law of every hinge for creases that do not cross, by the tilt of its axis at rest. In spatial
/// lattices the law is 2 theta, because rotors turn relative to gussets that do not turn.
std::vector<TurnLaw> usual_turn_laws(const Linkage& linkage);

/// Returns the direction in which the upper body of a hinge turns about the axis as theta grows, relative to
/// the lower body: +1 or -1.
int hinge_sense(const Linkage& linkage, int hinge);

}  // namespace kinetix::model
