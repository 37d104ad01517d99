#pragma once

#include "model/elastic/path/branch.hpp"
#include "model/elastic/path/closed_form.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/elastic/path/measured_system.hpp"
#include "model/elastic/path/path_head.hpp"
#include "model/elastic/path/step_solver.hpp"

namespace kinetix::model {

/// Detector for jamming: with contact, the load rises far more steeply with the drive than without.
class JammingDetector {
 public:
  /// Processes a step. @return ratio of slopes with and without contact, on the step that first shows
  /// jamming. The step must end in contact; if the slope at its end is unknown, it must also start in contact
  std::optional<double> see(const EquilibriumStep& before, const EquilibriumStep& after);
  /// Returns what see() would return for a step that is not taken yet.
  std::optional<double> peek(const EquilibriumStep& before, const EquilibriumStep& after) const;
  bool has_locked() const { return locked_; }

 private:
  double free_slope_ = 0;  ///< steepest slope of the load before contact: units of load per unit of the drive
  bool locked_ = false;
};

/// Detector for a tendon that would have to push.
class SlackDetector {
 public:
  /// Processes a step. @return true if the tendon would have to push, but not at the step before
  bool see(const EquilibriumStep& step);
  /// Returns what see() would return for a step that is not taken yet.
  bool peek(const EquilibriumStep& step) const;

 private:
  double largest_ = 0;  ///< load magnitude on the path, N
  bool slack_ = false;
};

/// How a path reached its last state.
struct Arrival {
  std::optional<Branch::Descent> descent;  ///< from an unstable equilibrium, if any
  bool snapped = false;                    ///< reached another state at nearly the same drive
  bool on_closed_form = false;             ///< whether the state is on the closed form
  bool located = false;                    ///< the event is between the last state and 1.2e-7 rad after it
};

/// Detector for events on the steps of a path that the user should know of.
class PathEvents {
 public:
  /// Keeps system and closed form by reference. @param on_closed_form whether the path starts on it
  PathEvents(const ElasticSystem& system, const ClosedForm& closed_form, bool on_closed_form)
      : system_(system), closed_form_(closed_form), branching_(system, closed_form, on_closed_form) {}

  /// Processes a step. @param state that of `after`
  void see(const EquilibriumStep& before, const EquilibriumStep& after, const State& state,
           const Arrival& arrival);
  /// Adds the events of a path that ends jammed at `last`.
  /// @param touching description of the contact in the next, refused state, as from
  ///   ElasticSystem::describe_touching
  /// @param why reason, as a sentence
  void end_locked(const EquilibriumStep& last, const std::string& touching, const std::string& why);

  /// Returns whether a step that is not taken yet would jam the structure or slacken a tendon.
  bool would_cause_event(const EquilibriumStep& before, const EquilibriumStep& after) const {
    return lock_.peek(before, after) || (system_.drive().only_pulls() && slack_.peek(after));
  }

  const std::vector<PathEvent>& events() const { return events_; }
  const OffClosedForm& off_closed_form() const { return off_; }

 private:
  /// Returns a sentence if the path leaves the closed form on this step, and no other event covers that.
  std::optional<std::string> departure(const EquilibriumStep& after, const State& state,
                                       const Arrival& arrival);
  void add(PathEvent::Kind kind, const EquilibriumStep& at, double since, std::string what);

  const ElasticSystem& system_;
  const ClosedForm& closed_form_;
  std::vector<PathEvent> events_;
  JammingDetector lock_;
  SlackDetector slack_;
  BranchingDetector branching_;
  OffClosedForm off_;
};

/// Reasons why the last attempted step of a path was refused.
struct Refusal {
  StepFaults faults;
  NewtonResult newton;   ///< result for the refused state
  std::string touching;  ///< description of the contact in the refused state; empty: none

  /// Returns the result of the path if there is no shorter step: `locked` if walls are involved.
  /// @param last step that was taken
  EquilibriumPath::Stop stop(const EquilibriumStep& last) const;
};

/// Describes in a sentence why and where a path stopped.
/// @param path its stop, gaps and steps are known
/// @param refusal of its next step, if that ended the path
/// @param off as in PathEvents
std::string stop_reason(const EquilibriumPath& path, const MeasuredSystem& system, double gap_limit,
                        const Refusal& refusal, const OffClosedForm& off);

/// Steps that a path took, with their events.
class PathRecord {
 public:
  /// @param closed_form of the system
  /// @param head at its first state
  /// @param frame called with every state
  /// All parameters are kept by reference.
  PathRecord(const MeasuredSystem& system, const ClosedForm& closed_form, const PathHead& head,
             const EquilibriumPathOptions& options,
             const std::function<void(const EquilibriumStep&, const State&)>& frame);

  const EquilibriumStep& last() const { return path_.steps.back(); }
  bool is_overstretched() const { return last().gap > options_.gap_limit; }

  /// Records that the head has reached a new state.
  void add(const EquilibriumStep& step, const Arrival& arrival);
  /// Returns whether a step that is not taken yet would cause an event, as PathEvents::would_cause_event.
  bool would_cause_event(const EquilibriumStep& before, const EquilibriumStep& after) const {
    return events_.would_cause_event(before, after);
  }
  /// Adds iterations of Newton's method, including those of refused steps.
  void count(int iterations) { path_.iterations += iterations; }

  /// Returns the whole path, which ends at the head. @param refusal of the next step, if that ended the path
  EquilibriumPath finished(EquilibriumPath::Stop stop, const Refusal& refusal);

 private:
  void append(const EquilibriumStep& step);

  const MeasuredSystem& system_;
  const ClosedForm& closed_form_;
  const PathHead& head_;
  const EquilibriumPathOptions& options_;
  const std::function<void(const EquilibriumStep&, const State&)>& frame_;
  EquilibriumPath path_;
  PathEvents events_;
};

}  // namespace kinetix::model
