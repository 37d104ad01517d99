#pragma once

#include "model/linkage/turn_law.hpp"
#include "model/sheet/sheet.hpp"

namespace kinetix::model {

/// How every hinge of a sheet turns along its exact motion. @pre exact_motion(sheet) has one
std::vector<TurnLaw> turn_laws(const Sheet& sheet);

}  // namespace kinetix::model
