#pragma once

#include <optional>
#include <string>

#include "model/lattice/lattice_motion.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// The key `press` of plates.
targets::Key press_key();
/// The `drive:` key of a design.
targets::Key drive_key();

/// Nothing without the section, or where it names a side alone, which says nothing of where to go.
/// @param structure with all its hinges
/// @throws InvalidInput for whatever formats.md does not allow: among others a part to grip that is not
/// there or, in an exactly mobile structure, whose rows leave the planes of their plates; a cord that nothing shortens
std::optional<model::Drive> read_drive_section(const targets::Section& root, const model::Lattice& structure);

/// The section's text; a side of 1 goes without saying.
std::string drive_text(const model::Lattice& structure, const std::optional<model::Drive>& drive, int side);

/// Describes what moves a structure.
const char* describe(const model::Drive& drive);

/// Which way to leave a bifurcation that the drive leaves open, 1 or -1.
int read_side(const targets::Section& root);

}  // namespace kinetix::app
