#pragma once

#include <functional>

#include "model/elastic/path/path_events.hpp"
#include "model/elastic/path/path_head.hpp"
#include "model/elastic/path/path_stop.hpp"

namespace kinetix::model {

/// The steps that a path took, and what happened on them.
class PathRecord {
 public:
  /// @param closed_form of the system  @param head at its first state  @param frame sees every state  All parameters are kept by reference.
  PathRecord(const MeasuredSystem& system, const ClosedForm& closed_form, const PathHead& head,
             const EquilibriumPathOptions& options,
             const std::function<void(const EquilibriumStep&, const State&)>& frame);

  const EquilibriumStep& last() const { return path_.steps.back(); }
  bool is_overstretched() const { return last().gap > options_.gap_limit; }

  /// The head has come to a new state.
  void add(const EquilibriumStep& step, const Arrival& arrival);
  /// PathEvents::would_happen
  bool would_happen(const EquilibriumStep& before, const EquilibriumStep& after) const {
    return events_.would_happen(before, after);
  }
  /// Iterations of Newton's method, also of steps that are not taken.
  void count(int iterations) { path_.iterations += iterations; }

  /// The whole path, which ends where the head is. @param refusal of the next step, if that is why
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
