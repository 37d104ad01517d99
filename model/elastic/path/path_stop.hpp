#pragma once

#include <string>

#include "model/elastic/path/departure.hpp"
#include "model/elastic/path/measured_system.hpp"
#include "model/elastic/path/step_check.hpp"

namespace kinetix::model {

/// Why the last step that a path tried was not taken.
struct Refusal {
  StepFaults faults;
  NewtonResult newton;   ///< that led there
  std::string touching;  ///< in the state that was not taken, in words; empty: nothing

  /// What the path ends with if there is no shorter step: `locked` where walls have to do with it.
  /// @param last step that was taken
  EquilibriumPath::Stop stop(const EquilibriumStep& last) const;
};

/// In a sentence, why and where a path stopped.
/// @param path its stop, gaps and steps are known  @param refusal of its next step, if that is why
/// @param off as in PathEvents
std::string stop_reason(const EquilibriumPath& path, const MeasuredSystem& system, double gap_limit,
                        const Refusal& refusal, const OffClosedForm& off);

}  // namespace kinetix::model
