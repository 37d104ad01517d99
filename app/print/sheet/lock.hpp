#pragma once

#include "app/print/sheet/print_sheet.hpp"

namespace kinetix::app {

/// Adds the lock that keeps a sheet folded: posts or eyes on two bodies, and the clip over the posts. The bodies are
/// those whose distance shrinks most from flat to the fold, of those that leave room. Posts and eyes keep the clearance
/// of all parts along the path. Clip and strap are straight in the fold, and nothing else is there.
/// @param kind not LockKind::none
/// @pre the sheet without a lock has its clearance.
/// @throws InvalidInput, one sentence, if no two bodies leave room, the fold is not known, or the sheet is cut
void add_lock(PrintSheet& sheet, LockKind kind);

/// Adds a clip, else a strap, that its hinges do not break. It tries few pairs of bodies. Sheets that are cut have no
/// posts.
/// @return whether there is one; else the sheet stays as it is
bool add_default_lock(PrintSheet& sheet);

}  // namespace kinetix::app
