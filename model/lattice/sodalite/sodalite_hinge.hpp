#pragma once

#include "model/lattice/sodalite/sodalite.hpp"

namespace kinetix::model {

/// Returns a hinge at rest: its axis is the rotor's, at 45 degrees to its wall, except for print errors.
RestHinge rest_hinge(const SodaliteStructure& structure, int hinge);

}  // namespace kinetix::model
