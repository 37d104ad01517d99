#pragma once

#include <string>

#include "app/files/structure_section.hpp"
#include "model/sheet/sheet.hpp"

namespace kinetix::app {

/// The key `structure` of a file that may name any lattice.
targets::Key lattice_structure_key();

/// The flat sheet, all hinges basic.
/// @throws InvalidInput for whatever formats.md does not allow: among others cells that do not hang together, a
/// graph with crossing walls or a loop of an odd number of them, and a key that the lattice does not take
model::Sheet read_sheet(const targets::Node& structure);

/// The section's text, from which read_sheet draws the same sheet.
std::string structure_text(const model::Sheet& sheet);

}  // namespace kinetix::app
