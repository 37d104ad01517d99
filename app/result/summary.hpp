#pragma once

#include "app/console/short_form.hpp"
#include "app/pipeline/drive_loads.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {

/// Returns the summary lines of an equilibrium, each a label and a text. @pre run.equilibrium
std::vector<std::array<std::string, 2>> equilibrium_lines(const Run& run);

/// Composes the short form of tried drives: those with the least force and the least work.
ShortForm short_form(const DriveTrials& trials);
/// Returns a table of the tried drives, one line each, and the drives with the least force and the least work.
std::string summary(const DriveTrials& trials);
/// Returns the tried drives as JSON, `schema` kinetix-drives/1.
nlohmann::ordered_json drive_trials_json(const DriveTrials& trials);

}  // namespace kinetix::app
