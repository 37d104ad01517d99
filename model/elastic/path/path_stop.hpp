#pragma once

#include <string>

#include "model/elastic/path/departure.hpp"
#include "model/elastic/path/measured_system.hpp"
#include "model/elastic/path/step_check.hpp"

namespace kinetix::model {

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

}  // namespace kinetix::model
