#include "model/elastic/path/path_record.hpp"

#include <cmath>
#include <utility>

namespace kinetix::model {

PathRecord::PathRecord(const MeasuredSystem& system, const ClosedForm& closed_form, const PathHead& head,
                       const EquilibriumPathOptions& options,
                       const std::function<void(const EquilibriumStep&, const State&)>& frame)
    : system_(system),
      closed_form_(closed_form),
      head_(head),
      options_(options),
      frame_(frame),
      events_(system.elastic, closed_form, head.on_closed_form()) {
  path_.planar = system.planar;
  append(system.measured(head.state(), head.theta(), head.has_tangent()));
}

void PathRecord::add(const EquilibriumStep& step, const Arrival& arrival) {
  const EquilibriumStep before = last();
  append(step);
  events_.see(before, step, head_.state(), arrival);
}

void PathRecord::append(const EquilibriumStep& step) {
  path_.steps.push_back(step);
  if (frame_) frame_(step, head_.state());
}

EquilibriumPath PathRecord::finished(EquilibriumPath::Stop stop, const Refusal& refusal) {
  path_.stop = stop;
  path_.state = head_.state();
  path_.theta = head_.theta();
  path_.gaps = hinge_gaps(system_.elastic.structure(), path_.state);
  path_.why = stop_reason(path_, system_, options_.gap_limit, refusal, events_.off_closed_form());
  path_.off_closed_form_since = events_.off_closed_form().since;
  path_.off_closed_form =
      std::isfinite(path_.off_closed_form_since) || closed_form_.is_far(path_.state, path_.theta);
  if (stop == EquilibriumPath::Stop::locked) events_.end_locked(last(), refusal.touching, path_.why);
  path_.events = events_.events();
  path_.hinge_energies = system_.hinge_energies(path_.state);
  path_.multiplier = system_.elastic.multiplier();
  return std::move(path_);
}

}  // namespace kinetix::model
