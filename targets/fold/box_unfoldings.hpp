#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "targets/fold/fold_net.hpp"

namespace kinetix::targets {

/// Names of a box's faces: bottom, top, front, back, left, right, in this order.
const std::vector<std::string>& box_face_names();
/// Of a face by box_face_names: 0, 1, 2 for the axis x, y, z that it is normal to.
int box_face_axis(int face);

/// All ways to cut a box open into one flat piece, no two congruent (11 for a cube), all folds 90 degrees.
/// First those whose faces are the fewest folds apart, among these those of the smallest bounding rectangle.
/// The first face of each net is the bottom, or the next one in order where the bottom is open.
/// @param edges cells along x, y, z: the bottom has edges[0] x edges[1]
/// @param open index of a face that is left out
std::vector<FoldNet> box_unfoldings(const std::array<int, 3>& edges, std::optional<int> open = {});

}  // namespace kinetix::targets
