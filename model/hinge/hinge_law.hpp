#pragma once

#include <memory>

namespace kinetix::model {

/// Response of a hinge to a turn.
struct TurnResponse {
  double energy = 0;     ///< in the unit of k_turn
  double stiffness = 0;  ///< of its moment by the turn, in the unit of k_turn; 0 only if the moment is 0
  double stretch = 0;    ///< moment / stiffness, rad: the turn itself if the law is linear
  double energy_k = 0;   ///< derivative of the energy by k_turn, rad^2
  double moment_k = 0;   ///< derivative of the moment by k_turn, rad

  double moment() const { return stiffness * stretch; }  ///< in the unit of k_turn
};

/// Turning law of a hinge, the only description of it for the elastic model and the simulation. A custom law
/// derives from this class and is set in Elasticity::law. The response of the hinge point does not depend on
/// the law (Elasticity).
class HingeLaw {
 public:
  virtual ~HingeLaw() = default;
  /// @param turn from rest, rad, in [-pi, pi]   @param k_turn > 0, in any unit of energy
  virtual TurnResponse at(double turn, double k_turn) const = 0;
};

/// Law with the energy 1/2 k_turn turn^2.
class LinearHinge final : public HingeLaw {
 public:
  TurnResponse at(double turn, double k_turn) const override {
    return {0.5 * k_turn * turn * turn, k_turn, turn, 0.5 * turn * turn, turn};
  }
};

/// Law with the energy 1/2 k_turn (turn - set)^2: a hinge with a permanent set, such as plastic that was
/// heated while folded.
class SetHinge final : public HingeLaw {
 public:
  /// @param set turn at which it rests, rad, in [-pi, pi]
  explicit SetHinge(double set) : set_(set) {}
  TurnResponse at(double turn, double k_turn) const override;

 private:
  double set_;
};

/// Returns the shared LinearHinge, the default law of an Elasticity.
const std::shared_ptr<const HingeLaw>& linear_hinge();

}  // namespace kinetix::model
