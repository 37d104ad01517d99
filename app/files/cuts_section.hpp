#pragma once

#include "app/files/design_file.hpp"
#include "app/io/atomic_file.hpp"
#include "targets/drawing/cut_sheet.hpp"

namespace kinetix::app {

/// Returns the keys of a `structure:` whose sheet is drawn by its cuts.
const targets::KeyTable& cuts_keys();

/// Reads a sheet with cuts into a design: pieces as bodies, bridges and creases as hinges, and the process that cuts
/// it. Without a drive its pieces are pulled apart.
/// @param root the whole document
/// @throws InvalidInput for drawings that cannot be read, sheets that do not come apart, and processes that print
void read_cuts(const targets::Section& root, Design& design);

/// Returns the text of the section `structure`, of the process, and the drawing that it names. @pre design.cuts
std::string cuts_text(const Design& design);
NamedContent cuts_file(const Design& design);

/// Returns the sizes of the bridge or crease between two pieces. A bridge is at least half as long as wide: an estimate,
/// since the material next to it yields with it.
model::ManufacturedHinge joint_hinge(const targets::SheetJoint& joint, const model::Process& process);

/// Describes pieces and bridges of a sheet with cuts for `check`.
std::string describe_cuts(const targets::CutSheet& sheet, double kerf_mm);

}  // namespace kinetix::app
