#pragma once

#include <optional>

#include "model/elastic/elastic_system.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::model {

/// The closed form of an elastic system's linkage, where there is one, in the place where the drive holds it:
/// plates face each other, the body at which another drive is held rests. Of shape memory there is none: how far its springs
/// fold a sheet is for its hinges to say.
class ClosedForm {
 public:
  /// Both are kept by reference.
  ClosedForm(const ElasticSystem& system, const ExactMotion& exact) : system_(system), exact_(exact) {}

  /// At fold parameter theta, rad, what the drive grips in place.
  std::optional<State> at(double theta) const;
  /// Largest difference of a hinge's turn between a state and the closed form at theta, rad.
  std::optional<double> distance(const State& state, double theta) const;
  /// Whether that is at most `near`. @return false where there is no closed form
  bool is_near(const State& state, double theta) const;
  /// Whether that is more than `far`. @return false where there is no closed form
  bool is_far(const State& state, double theta) const;
  /// Whether a sheet between plates or on a cord, which force it to one side as little as to the other, lies on the closed
  /// form of the side that theta does not ask for.
  bool is_mirrored(const State& state, double theta) const;

  static constexpr double near = 0.01;  ///< rad of a hinge: up to here, a path keeps to the closed form
  /// Rad of a hinge, beyond which a state is another one: what the springs of a sheet bend its closed form by is a tenth of
  /// that, another motion soon more.
  static constexpr double far = 0.1;

 private:
  void hold_by_body(State& state, const State& rest) const;
  void hold_by_plates(State& state, const State& rest) const;

  const ElasticSystem& system_;
  const ExactMotion& exact_;
};

}  // namespace kinetix::model
