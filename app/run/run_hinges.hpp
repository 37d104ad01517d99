#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/run/run.hpp"
#include "model/matter/hinge_strain.hpp"

namespace kinetix::app {

/// What a hinge of a run's sheet is made of: its own, or what all others are.
const HingeSection& hinge_section(const Run& run, int hinge);

/// How hinges of the run's sheet are made, each kind once; none where the file does not say. @pre solved
std::vector<model::MadeHinge> made_hinges(const Run& run);

/// The pin with the largest clearance that does not move freely within it: what scatters by its play.
std::optional<model::MadeHinge> loosest_pin(const Run& run);

/// By how much walls of the run's prints stand out of place and lean: the errors of the process, and the play of the loosest pin.
model::PrintError wall_error(const Run& run);

/// Whether the material of every block and film bears its strain in a state of the sheet.
bool bears_its_strain(const Run& run, const model::State& state);

/// The hinge that is strained farthest beyond what its material bears in a state of the sheet, in words; nothing where all
/// bear theirs.
std::optional<std::string> strained_too_far(const Run& run, const model::State& state);
/// The same words of any hinge. @param wall its name   @param when "" or what follows, such as " on the way to the fold"
std::string strained_words(const model::StrainedHinge& worst, const std::string& wall, const char* when = "");

/// What the run's process cannot print of its sheet, each once.
std::vector<model::PrintProblem> print_problems(const Run& run);

}  // namespace kinetix::app
