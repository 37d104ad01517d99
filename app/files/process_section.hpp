#pragma once

#include "model/material/process.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// Returns the keys of a `process:` that is a section.
const targets::KeyTable& process_keys();
/// Returns the `process:` key of a target: how it is to be printed, by name or as a section of differences from a
/// base.
targets::Key process_key();
/// Returns the `process:` key of a design.
targets::Key design_process_key();
/// Returns the `bed_mm:` key: the bed of the user's printer.
targets::Key bed_key();
/// Kind of lock that keeps a sheet folded.
enum class LockKind { none, clip, strap };

/// Returns "none", "clip" or "strap", as in files.
std::string to_string(LockKind kind);
/// Returns the `lock:` key.
targets::Key lock_key();
/// Reads the kind of lock; empty if the file does not name it. @param root the whole document
std::optional<LockKind> read_lock(const targets::Section& root);

/// Returns the key's text for a process: its name, or its base with the differences.
/// @pre the base exists, and has the same upright clearance, bed and materials
std::string process_text(const model::Process& process);

/// Reads the process and the bed of its printer. The default is the first process, as the paper prints.
/// A sheet that walls are cut from is as thick as the file's walls are high, if it gives their height.
/// @param root the whole document
/// @throws InvalidInput for walls that are not as high as the sheet that they are cut from
model::Process read_process(const targets::Section& root);

/// Returns the height that walls have because they are cut from a sheet, mm. Empty for a file that gives the height of
/// its walls, and for processes that print.
std::optional<double> open_wall_height_mm(const targets::Node& root);

}  // namespace kinetix::app
