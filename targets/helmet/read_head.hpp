#pragma once

#include <vector>

#include "targets/document/section.hpp"
#include "targets/helmet/head.hpp"

namespace kinetix::targets {

/// Keys of a target section that say what the head is and how it stands, but for coverage_mm.
std::vector<Key> head_keys();
Key coverage_key();

/// The head of a target section: `mesh` (an OBJ, STL or PLY file, relative to the document's folder) and, all
/// optional, `units` (mm, cm, m or in; default mm), `up` and `front` (x, -x, +x, y, ...; default z, and
/// whichever way the head is longer), `crown` ([x, y, z] in mm and in the mesh's axes; default the highest
/// point) and `coverage_mm` (depth below the crown; default 90).
/// @throws InvalidInput at the key at fault for what read_mesh and make_head refuse
Head read_head(const Section& target);

}  // namespace kinetix::targets
