#pragma once

#include "model/material/process.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// Returns the `process:` key of a target: how it is to be printed, by name or as a section of differences from a
/// base.
targets::Key process_key();
/// Returns the `process:` key of a design.
targets::Key design_process_key();
/// Returns the key's text for a process: its name, or its base with the differences.
/// @pre the base exists, and has the same upright clearance, bed and materials
std::string process_text(const model::Process& process);

/// Describes what a process cannot print, with the cell edge at which it could.
std::string problem_text(const model::PrintProblem& problem);

/// Adds notes to a forecast on what a process cannot print of a whole sheet, each once.
void note_process(const model::Process& process, const model::CellSize& size,
                  const std::optional<model::ManufacturedHinge>& made, std::vector<std::string>& notes);

/// Reads the process. The default is the first process, as the paper prints.
/// @param root the whole document   @param made its hinges, if it says how they are made
/// @throws InvalidInput also if the file names a process that cannot print the sheet
model::Process read_process(const targets::Section& root, const model::CellSize& size,
                            const std::optional<model::ManufacturedHinge>& made);
/// Reads the process of a file that does not give the size of the sheet yet.
model::Process read_process(const targets::Section& root);

}  // namespace kinetix::app
