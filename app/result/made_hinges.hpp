#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/run/run.hpp"

namespace kinetix::app {

/// Strain of an elastomer or living hinge.
struct HingeStrain {
  double strain = 0;   ///< ratio of lengths
  double allowed = 0;  ///< largest strain of the material, ratio of lengths
};

/// Returns the strain of the hinge with the largest ratio of strain to allowed strain, in the reported state.
/// @return nullopt without elastomer and living hinges, or without a state
std::optional<HingeStrain> worst_strain(const Run& run);

/// Returns the reasons why the run's process cannot print the sheet, or why its hinges do not fit. Empty for a run
/// without a goal, because the process of a design is not known.
std::vector<std::string> unprintable(const Run& run);

/// Returns label and text of each problem of made hinges, for the terminal:
/// PRINT: the process cannot print it. STRAINED: a hinge exceeds the strain of its material.
/// CORNERS: the two halves of a wall collide over the gap before the state is reached.
/// OFFSET: a hinge is farther from the middle of its wall than its kind allows.
/// For all but PRINT, only the worst case is listed.
std::vector<std::pair<std::string, std::string>> made_hinge_lines(const Run& run);

/// Returns these problems for result.json, with labels in lower case.
nlohmann::ordered_json made_problems_json(const Run& run);

}  // namespace kinetix::app
