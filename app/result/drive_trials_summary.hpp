#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/pipeline/drive_trials.hpp"

namespace kinetix::app {

/// A table of the drives that were tried, a line each, and which needs the least force and the least work.
std::string summary(const DriveTrials& trials);
/// The same as a document, `schema` kinetix-drives/1.
nlohmann::ordered_json drive_trials_json(const DriveTrials& trials);

}  // namespace kinetix::app
