#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "targets/fold/fold_net.hpp"

namespace kinetix::targets {

/// Returns the names of a box's faces: bottom, top, front, back, left, right, in this order.
const std::vector<std::string>& box_face_names();
/// Returns the axis that a face is normal to: 0, 1, 2 for x, y, z. @param face position in box_face_names
int box_face_axis(int face);

/// Returns all ways to cut a box open into one flat piece, no two congruent (11 for a cube), all folds 90 degrees.
/// Nets whose faces are the fewest folds apart come first; ties go to the smallest bounding rectangle. The first face
/// of each net is the bottom, or the next one in order if the bottom is open.
/// @param edges cells along x, y, z: the bottom has edges[0] x edges[1]
/// @param open index of a face that is left out
std::vector<FoldNet> box_unfoldings(const std::array<int, 3>& edges, std::optional<int> open = {});

}  // namespace kinetix::targets
