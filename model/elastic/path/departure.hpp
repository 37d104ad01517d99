#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "model/elastic/path/closed_form.hpp"

namespace kinetix::model {

/// Since when a path is off its closed form.
struct OffClosedForm {
  double since = NAN;     ///< theta, rad; NaN: it is not, or there is none
  bool unstable = false;  ///< for the closed form being unstable there
};

/// Notices that a path which came along its closed form is no longer near it. No instability need tell of that: where the
/// hinge points lose their hold on a second motion, the springs alone decide, and the equilibrium bends smoothly over to the
/// motion that costs them less.
class DepartureWatch {
 public:
  /// System and closed form are kept by reference.  @param on_closed_form whether the path begins there
  DepartureWatch(const ElasticSystem& system, const ClosedForm& closed_form, bool on_closed_form)
      : system_(system),
        closed_form_(closed_form),
        place_(on_closed_form ? Place::on_it : Place::elsewhere) {}

  /// The path has come to a state at theta, rad. A closed form whose walls touch is not there to be left.
  /// @param came_along whether it came along the closed form, and is near it
  /// @return how far off it is, rad of a hinge, on the first step that leaves it: more than 0.1
  std::optional<double> see(const State& state, double theta, bool came_along);
  /// Whether it is near the closed form, or was when that came to touch its own walls.
  bool is_back() const { return place_ != Place::left; }

 private:
  enum class Place { elsewhere, on_it, left };

  const ElasticSystem& system_;
  const ClosedForm& closed_form_;
  Place place_;
};

/// How far a path is from the closed form that it has left, and why, in words: because a second motion begins near there,
/// the smallest singular value of the closure equations being below a quarter of flat's (NullSpace), or several begin in
/// the flat state, or else because the hinges give way.
/// @param turn as of DepartureWatch, rad  @param theta of the state, rad
/// @pre there is a closed form at theta
std::string departure_words(const ElasticSystem& system, const ClosedForm& closed_form, const State& state,
                            double theta, double turn);

}  // namespace kinetix::model
