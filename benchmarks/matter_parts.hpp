#pragma once

#include "benchmarks/figure.hpp"

namespace kinetix::bench {

/// Parts of the group `matter`: blocks against CalculiX, and sheets of rubber blocks in equilibrium against the physics run.
std::vector<Figure> block_stiffness_figures();
std::vector<Figure> framed_physics_figures();

}  // namespace kinetix::bench
