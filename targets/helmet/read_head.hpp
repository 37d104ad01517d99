#pragma once

#include <vector>

#include "targets/document/section.hpp"
#include "targets/helmet/head.hpp"

namespace kinetix::targets {

/// Returns the keys of a target section that describe the head and its pose, except coverage_mm.
std::vector<Key> head_keys();
Key coverage_key();

/// Reads the head of a target section. `mesh` is an OBJ, STL or PLY file, relative to the document's folder. All other
/// keys are optional:
///   - `units`: mm, cm, m or in; default mm.
///   - `up` and `front`: x, -x, +x, y, ...; default z, and the axis along which the head is longer.
///   - `crown`: [x, y, z] in mm and in the mesh's axes; default the highest point.
///   - `coverage_mm`: depth below the crown; default 90.
/// @throws InvalidInput at the key at fault for what read_mesh and make_head refuse
Head read_head(const Section& target);

}  // namespace kinetix::targets
