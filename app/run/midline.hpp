#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/lattice/lattice.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::app {

/// (x, z), mm, of the mean of the bodies of each column.
std::vector<Eigen::Vector2d> column_midline(const model::Lattice& structure, const model::State& state);

}  // namespace kinetix::app
