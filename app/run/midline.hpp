#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/lattice/lattice.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::app {

/// Returns the mean position (x, z) of the bodies of each column, mm.
std::vector<Eigen::Vector2d> column_midline(const model::Lattice& structure, const model::State& state);

}  // namespace kinetix::app
