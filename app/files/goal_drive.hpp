#pragma once

#include <optional>

#include "model/sheet/sheet_motion.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// The `drive:` key of goals of exact families.
targets::Key goal_drive_key();
/// The springs that are to fold a sheet of elastic hinges, which have no angle yet; nothing: plates or one hinge, whichever folds
/// the sheet's family most evenly.
/// @param root the whole document
std::optional<model::ShapeMemory> read_goal_drive(const targets::Section& root);

}  // namespace kinetix::app
