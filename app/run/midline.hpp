#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/linkage/state.hpp"
#include "model/sheet/sheet.hpp"

namespace kinetix::app {

/// (x, z), mm, of the mean of the bodies of each column.
std::vector<Eigen::Vector2d> column_midline(const model::Sheet& structure, const model::State& state);

}  // namespace kinetix::app
