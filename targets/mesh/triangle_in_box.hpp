#pragma once

#include <array>

#include "model/base/oriented_box.hpp"

namespace kinetix::targets {

/// Whether a triangle, which may lack area, lies in a box, wholly or in part; touching counts. All in mm.
bool is_in_box(const std::array<Eigen::Vector3d, 3>& corners, const OrientedBox& box);

}  // namespace kinetix::targets
