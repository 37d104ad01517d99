#pragma once

#include "model/matter/process.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// The `process:` key of a target: how it is to be printed, by name or as a section of what differs from a base.
targets::Key process_key();
/// The same of a design.
targets::Key design_process_key();
/// What the key says of a process: its name, or that and what differs from it.
/// @pre of a base that there is, upright clearance, bed and materials as it has them
std::string process_text(const model::Process& process);

/// What a process cannot print, with the cell edge at which it could.
std::string problem_text(const model::PrintProblem& problem);

/// Adds what a process cannot print of a whole sheet to the notes of a forecast, each once.
void note_process(const model::Process& process, const model::CellSize& size,
                  const std::optional<model::MadeHinge>& made, std::vector<std::string>& notes);

/// The first process, as the paper prints, where the file names none.
/// @param root the whole document   @param made its hinges, where it says how they are made
/// @throws InvalidInput also where the file names a process that cannot print the sheet
model::Process read_process(const targets::Section& root, const model::CellSize& size,
                            const std::optional<model::MadeHinge>& made);
/// The same of a file that does not say yet how large the sheet is.
model::Process read_process(const targets::Section& root);

}  // namespace kinetix::app
