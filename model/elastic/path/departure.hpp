#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "model/elastic/path/closed_form.hpp"

namespace kinetix::model {

/// Theta from which a path is off its closed form.
struct OffClosedForm {
  double since = NAN;     ///< theta, rad; NaN: on the closed form, or there is none
  bool unstable = false;  ///< whether the closed form is unstable there
};

/// Detector for a path that leaves the closed form that it followed. This may happen without instability. If
/// the hinge points no longer prevent a second motion, only the springs decide. The equilibrium then bends
/// smoothly to the motion of less energy.
class DepartureWatch {
 public:
  /// Keeps system and closed form by reference. @param on_closed_form whether the path starts on it
  DepartureWatch(const ElasticSystem& system, const ClosedForm& closed_form, bool on_closed_form)
      : system_(system),
        closed_form_(closed_form),
        place_(on_closed_form ? Place::on_it : Place::elsewhere) {}

  /// Processes a new state of the path at theta, rad. A closed form with contact cannot be left.
  /// @param came_along whether the path followed the closed form up to here, and is near it.
  /// @return distance from it, rad of a hinge, on the first step that leaves it: more than 0.1
  std::optional<double> see(const State& state, double theta, bool came_along);
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
/// @param turn as returned by DepartureWatch, rad   @param theta of the state, rad
/// @pre there is a closed form at theta
std::string departure_words(const ElasticSystem& system, const ClosedForm& closed_form, const State& state,
                            double theta, double turn);

}  // namespace kinetix::model
