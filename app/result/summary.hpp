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

/// Composes the short form of a run: verdict, distance from the goal, sizes, prints, force, simulation and problems.
/// The console, the report and the studio show it. It has no files and no next command.
ShortForm short_form(const Run& run);

/// Returns the files of a run and the next command, for the console. @param folder of its results
std::vector<std::string> last_parts(const Run& run, const std::string& folder);

/// Returns the section `summary` of result.json: title and lines. Its problems are in `verdict`.
nlohmann::ordered_json short_json(const ShortForm& form);

/// Formats a short form for the studio's page, which has the long form under "Details".
std::string page_summary(ShortForm form);

/// Reads the short form of a result.json; its title is the name for results of earlier versions.
ShortForm short_form_of(const nlohmann::ordered_json& result);

}  // namespace kinetix::app
