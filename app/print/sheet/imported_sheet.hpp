#pragma once

#include "app/print/sheet/print_sheet.hpp"

namespace kinetix::app {

/// What is written of a design of imported bodies: its meshes as they are, at rest or turned as its drive says, and the way there.
/// @throws InvalidInput for a folded state that its drive does not come to
PrintSheet imported_sheet(const Design& design, const model::Process& process, bool folded);

}  // namespace kinetix::app
