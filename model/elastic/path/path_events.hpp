#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/elastic/path/branch.hpp"
#include "model/elastic/path/departure.hpp"
#include "model/elastic/path/equilibrium_path.hpp"

namespace kinetix::model {

/// Notices that walls carry the drive: the load rises far more steeply with it than it did without contact.
class LockWatch {
 public:
  /// @return how many times as steeply, on the first step between states in contact, or at the first state, that shows it
  std::optional<double> see(const EquilibriumStep& before, const EquilibriumStep& after);
  /// Likewise, of a step that is not taken yet.
  std::optional<double> look(const EquilibriumStep& before, const EquilibriumStep& after) const;
  bool has_locked() const { return locked_; }

 private:
  double free_slope_ = 0;  ///< steepest slope of the load before contact: units of load by those of the drive
  bool locked_ = false;
};

/// Notices that a cord would have to push.
class SlackWatch {
 public:
  /// @return whether it is the first step in a row at which it would
  bool see(const EquilibriumStep& step);
  /// Likewise, of a step that is not taken yet.
  bool look(const EquilibriumStep& step) const;

 private:
  double largest_ = 0;  ///< load on the way, N
  bool slack_ = false;
};

/// How a path came to its last state.
struct Arrival {
  std::optional<Branch::Descent> descent;  ///< from an unstable equilibrium, if from one
  bool snapped = false;                    ///< to another state at nearly the same drive
  bool on_closed_form = false;             ///< it lies there
  bool located = false;  ///< what happened there lies between the last state and 1.2e-7 rad behind it
};

/// Tells from the steps of a path what a user should know of.
class PathEvents {
 public:
  /// System and closed form are kept by reference.  @param on_closed_form whether the path begins there
  PathEvents(const ElasticSystem& system, const ClosedForm& closed_form, bool on_closed_form)
      : system_(system), closed_form_(closed_form), departure_(system, closed_form, on_closed_form) {}

  /// @param state that of `after`
  void see(const EquilibriumStep& before, const EquilibriumStep& after, const State& state,
           const Arrival& arrival);
  /// The path ends at `last`, locked by walls. @param touching in the state beyond that could not be taken, in words, as
  /// ElasticSystem::touching_words   @param why in words
  void end_locked(const EquilibriumStep& last, const std::string& touching, const std::string& why);

  /// Whether a step that is not taken yet would lock the structure, or take a cord slack.
  bool would_happen(const EquilibriumStep& before, const EquilibriumStep& after) const {
    return lock_.look(before, after) || (system_.drive().only_pulls() && slack_.look(after));
  }

  const std::vector<PathEvent>& events() const { return events_; }
  const OffClosedForm& off_closed_form() const { return off_; }

 private:
  /// Where the path is off the closed form from this step on, and no other event says so.
  std::optional<std::string> departure(const EquilibriumStep& after, const State& state,
                                       const Arrival& arrival);
  void add(PathEvent::Kind kind, const EquilibriumStep& at, double since, std::string what);

  const ElasticSystem& system_;
  const ClosedForm& closed_form_;
  std::vector<PathEvent> events_;
  LockWatch lock_;
  SlackWatch slack_;
  DepartureWatch departure_;
  OffClosedForm off_;
};

}  // namespace kinetix::model
