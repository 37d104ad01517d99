#pragma once

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

/// Theta from which a path is off its closed form.
struct OffClosedForm {
  double since = NAN;     ///< theta, rad; NaN: on the closed form, or there is none
  bool unstable = false;  ///< whether the closed form is unstable there
};

/// Detector for a path that leaves the closed form that it followed. This may happen without instability. If
/// the hinge points no longer prevent a second motion, only the springs decide. The equilibrium then bends
/// smoothly to the motion of less energy.
class BranchingDetector {
 public:
  /// Keeps system and closed form by reference. @param on_closed_form whether the path starts on it
  BranchingDetector(const ElasticSystem& system, const ClosedForm& closed_form, bool on_closed_form)
      : system_(system),
        closed_form_(closed_form),
        place_(on_closed_form ? Place::on_it : Place::elsewhere) {}

  /// Processes a new state of the path at theta, rad. A closed form with contact cannot be left.
  /// @param followed_closed_form whether the path followed the closed form up to here, and is near it.
  /// @return distance from it, rad of a hinge, on the first step that leaves it: more than 0.1
  std::optional<double> see(const State& state, double theta, bool followed_closed_form);
  /// Returns whether the path is near the closed form, or was when the closed form came into contact.
  bool is_back() const { return place_ != Place::left; }

 private:
  enum class Place { elsewhere, on_it, left };

  const ElasticSystem& system_;
  const ClosedForm& closed_form_;
  Place place_;
};

/// Describes how far a path is from the closed form that it left, and why. Causes: several motions start in
/// the flat state, a second motion starts near here, or the hinges give way. A second motion shows as a
/// smallest singular value of the closure equations (NullSpace) below a quarter of that of flat.
/// @param turn as returned by BranchingDetector, rad   @param theta of the state, rad
/// @pre there is a closed form at theta
std::string describe_branching(const ElasticSystem& system, const ClosedForm& closed_form, const State& state,
                               double theta, double turn);

}  // namespace kinetix::model
