#pragma once

#include "app/print/sheet/print_sheet.hpp"

namespace kinetix::app {

/// Makes the sheet of a design of imported bodies: its meshes as they are, at rest or turned by its drive, and the
/// motion.
/// @throws InvalidInput for a folded state that its drive does not reach
PrintSheet imported_sheet(const Design& design, const model::Process& process, bool folded);

}  // namespace kinetix::app
