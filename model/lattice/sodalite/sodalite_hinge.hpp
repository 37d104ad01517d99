#pragma once

#include "model/lattice/sodalite/sodalite.hpp"

namespace kinetix::model {

/// A hinge at rest: its axis is the rotor's, at 45 degrees to its wall, but for what errors of print do to it.
RestHinge rest_hinge(const SodaliteStructure& structure, int hinge);

}  // namespace kinetix::model
