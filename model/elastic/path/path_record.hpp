#pragma once

#include <functional>

#include "model/elastic/path/path_events.hpp"
#include "model/elastic/path/path_head.hpp"
#include "model/elastic/path/path_stop.hpp"

namespace kinetix::model {

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
  /// Returns whether a step that is not taken yet would cause an event, as PathEvents::would_happen.
  bool would_happen(const EquilibriumStep& before, const EquilibriumStep& after) const {
    return events_.would_happen(before, after);
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
