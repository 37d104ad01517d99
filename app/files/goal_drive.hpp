#pragma once

#include "targets/document/section.hpp"

namespace kinetix::app {

/// What moves a sheet of elastic hinges that was searched for by closed form.
struct GoalDrive {
  enum class Kind {
    usual,         ///< plates or one hinge, whichever folds the sheet's family most evenly
    shape_memory,  ///< a spring in each hinge that wants to turn it
  };

  Kind kind = Kind::usual;
  double k_turn = 0;  ///< of each spring, N mm/rad

  bool operator==(const GoalDrive&) const = default;
};

/// The `drive:` key of goals of exact families.
targets::Key goal_drive_key();
/// @param root the whole document
GoalDrive read_goal_drive(const targets::Section& root);

}  // namespace kinetix::app
