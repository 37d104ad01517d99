#pragma once

#include "model/matter/process.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// The `process:` key: how a design is to be printed, by name or as {base, sd: {t_mm, tilt_deg, clearance_mm}}.
targets::Key process_key();

/// The first process, as the paper prints, where the file names none.
/// @param root the whole document
model::Process read_process(const targets::Section& root);

}  // namespace kinetix::app
