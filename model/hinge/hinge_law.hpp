#pragma once

#include <memory>

namespace kinetix::model {

/// The answer of a hinge to a turn.
struct TurnResponse {
  double energy = 0;     ///< in the unit of k_turn
  double stiffness = 0;  ///< of its moment by the turn, in the unit of k_turn; not 0 where the moment is not
  double stretch = 0;    ///< its moment over that stiffness, rad: the turn itself where the law is linear
  double energy_k = 0;   ///< derivative of the energy by k_turn, rad^2
  double moment_k = 0;   ///< and of the moment, rad

  double moment() const { return stiffness * stretch; }  ///< in the unit of k_turn
};

/// How a hinge resists its turn. All that elastic model and physics know of it: a law of one's own derives
/// from this and goes into Elasticity::law. What a hinge point does is the same for all laws (Elasticity).
class HingeLaw {
 public:
  virtual ~HingeLaw() = default;
  /// @param turn from rest, rad, in [-pi, pi]   @param k_turn > 0, in any unit of energy
  virtual TurnResponse at(double turn, double k_turn) const = 0;
};

/// 1/2 k_turn turn^2.
class LinearHinge final : public HingeLaw {
 public:
  TurnResponse at(double turn, double k_turn) const override {
    return {0.5 * k_turn * turn * turn, k_turn, turn, 0.5 * turn * turn, turn};
  }
};

/// 1/2 k_turn (turn - set)^2: a hinge that was folded by `set` and keeps it, as plastic that was heated there does.
class SetHinge final : public HingeLaw {
 public:
  /// @param set turn at which it rests, rad, in [-pi, pi]
  explicit SetHinge(double set) : set_(set) {}
  TurnResponse at(double turn, double k_turn) const override;

 private:
  double set_;
};

/// The one LinearHinge, which an Elasticity has unless told otherwise.
const std::shared_ptr<const HingeLaw>& linear_hinge();

}  // namespace kinetix::model
