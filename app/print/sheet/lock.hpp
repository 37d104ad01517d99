#pragma once

#include "app/print/sheet/print_sheet.hpp"

namespace kinetix::app {

/// Adds the lock that keeps a sheet folded: posts or eyes on two bodies, and the clip over the posts. The bodies are
/// those whose distance shrinks most from flat to the fold, of those that leave room. Posts and eyes keep the clearance
/// of all parts along the path. Clip and strap are straight in the fold, and nothing else is there.
/// @param kind not LockKind::none
/// @throws InvalidInput, one sentence, if no two bodies leave room or the fold is not known
void add_lock(PrintSheet& sheet, LockKind kind);

}  // namespace kinetix::app
