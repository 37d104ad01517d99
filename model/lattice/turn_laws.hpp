#pragma once

#include "model/lattice/lattice.hpp"
#include "model/linkage/turn_law.hpp"

namespace kinetix::model {

/// How every hinge of a sheet turns along its exact motion. @pre exact_motion(sheet) has one
std::vector<TurnLaw> turn_laws(const Lattice& sheet);

}  // namespace kinetix::model
