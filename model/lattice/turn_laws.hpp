#pragma once

#include "model/lattice/lattice.hpp"
#include "model/linkage/turn_law.hpp"

namespace kinetix::model {

/// Returns the turn law of every hinge along the sheet's exact motion. @pre exact_motion(sheet) has one
std::vector<TurnLaw> turn_laws(const Lattice& sheet);

}  // namespace kinetix::model
