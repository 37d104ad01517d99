#pragma once

#include <optional>

#include "model/elastic/elastic_system.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::model {

/// Closed form of an elastic system's linkage, if it has one, in the position of the drive. Plates face each
/// other; for other drives, the held body is at rest. For shape memory there is none, since its hinges
/// determine how far its springs fold a sheet.
class ClosedForm {
 public:
  /// Both are kept by reference.
  ClosedForm(const ElasticSystem& system, const ExactMotion& exact) : system_(system), exact_(exact) {}

  /// Returns the state at fold parameter theta, rad, with the gripped bodies in place.
  std::optional<State> at(double theta) const;
  /// Returns the largest difference of a hinge's turn between a state and the closed form at theta, rad.
  std::optional<double> distance(const State& state, double theta) const;
  /// Returns whether that distance is at most `near`. False if there is no closed form.
  bool is_near(const State& state, double theta) const;
  /// Returns whether that distance is more than `far`. False if there is no closed form.
  bool is_far(const State& state, double theta) const;
  /// Returns whether a sheet is on the closed form of the opposite side of theta. This is possible between
  /// plates or on a tendon, which do not select a side.
  bool is_mirrored(const State& state, double theta) const;

  static constexpr double near = 0.01;  ///< rad of a hinge: within it, a path follows the closed form
  /// Rad of a hinge. Above it, a state is different: springs bend the closed form of a sheet by a tenth of
  /// this, another motion soon by more.
  static constexpr double far = 0.1;

 private:
  void hold_by_body(State& state, const State& rest) const;
  void hold_by_plates(State& state, const State& rest) const;

  const ElasticSystem& system_;
  const ExactMotion& exact_;
};

}  // namespace kinetix::model
