#pragma once

#include <optional>

#include "model/classify.hpp"
#include "model/elastic/elastic_system.hpp"

namespace kinetix {

/// Ways down from a balance that is no minimum.
class Branch {
 public:
  /// @param goal fold parameter that the drive goes to  @param side +1 or -1: which way where neither the
  /// exact mode nor the sign of the drive tells
  Branch(const ElasticSystem& system, double goal, int side);

  enum class Way {
    exact,    ///< on the closed form of an exact family
    softest,  ///< along the softest direction
    none,     ///< that is neutral: nowhere to go
    unknown,  ///< it was not found
  };
  struct Start {
    Way way = Way::unknown;
    State state;
  };
  /// Where to start down from the balance `from` at theta: the state of the exact family where the structure
  /// belongs to one and it lies lower, else a step along the softest direction, with the sign that turns class
  /// A as the drive does where it turns the checkerboard at all; a valley that bends away from the step's line
  /// is met 0.05 rad or cell edges on. @param tangent of `from`
  Start leave(double theta, const State& from, Tangent& tangent) const;
  /// The closed form at theta of a structure that belongs to an exact family, where the drive holds it.
  std::optional<State> exact_state(double theta) const;

 private:
  State downhill(double theta, const State& from, const Eigen::VectorXd& along) const;
  double side_of(const Eigen::VectorXd& all) const;

  const ElasticSystem& system_;
  Classification family_;
  double goal_;
  int side_;
};

}  // namespace kinetix
