#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/pipeline/drive_trials.hpp"
#include "app/run/drive_end.hpp"

namespace kinetix::app {

/// What the summary says of an equilibrium: lines of a label and a text. @pre run.equilibrium
std::vector<std::array<std::string, 2>> equilibrium_lines(const Run& run);

/// A table of the drives that were tried, a line each, and which needs the least force and the least work.
std::string summary(const DriveTrials& trials);
/// The same as a document, `schema` kinetix-drives/1.
nlohmann::ordered_json drive_trials_json(const DriveTrials& trials);

}  // namespace kinetix::app
