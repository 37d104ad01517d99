#pragma once

#include <optional>
#include <string>

#include "model/lattice/lattice_motion.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// Returns the key `press` of plates.
targets::Key press_key();
/// Returns the `drive:` key of a design.
targets::Key drive_key();

/// Reads the drive. Empty without the section, or if it names only a side, which sets no goal.
/// @param structure with all its hinges
/// @throws InvalidInput for all that formats.md does not allow. Examples: a part to grip that does not exist, and a
/// tendon that nothing shortens. In an exactly mobile structure, also a part to grip whose rows leave the planes of
/// their plates.
std::optional<model::Drive> read_drive_section(const targets::Section& root, const model::Lattice& structure);

/// Returns the section's text. A side of 1, the default, is left out.
std::string drive_text(const model::Lattice& structure, const std::optional<model::Drive>& drive, int side);

/// Describes what moves a structure.
const char* describe(const model::Drive& drive);

/// Reads the branch to take at a bifurcation that the drive leaves open, 1 or -1.
int read_side(const targets::Section& root);

}  // namespace kinetix::app
