#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/run/run.hpp"

namespace kinetix::app {

struct HingeStrain {
  double strain = 0;   ///< of a block or film, a ratio of lengths
  double allowed = 0;  ///< what its material bears, a ratio of lengths too
};

/// Of the hinge that comes nearest to what its material bears, or is farthest beyond, in the state shown.
/// @return nothing where no hinge is a block or film, or there is no state
std::optional<HingeStrain> worst_strain(const Run& run);

/// What the run's process cannot print of its sheet, in words, and why its hinges do not fit: none of a design, whose process
/// is not known.
std::vector<std::string> unprintable(const Run& run);

/// Label and words for the terminal: what the process cannot print, a hinge that is strained by more than its material bears, a wall whose two
/// halves meet over the gap before the state is reached, and a hinge farther off the middle of its wall than its
/// kind can be made; the worst of each, none where all is well.
std::vector<std::pair<std::string, std::string>> made_hinge_lines(const Run& run);

/// The same as result.json has it, the labels in lower case.
nlohmann::ordered_json made_problems_json(const Run& run);

}  // namespace kinetix::app
