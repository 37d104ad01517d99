#pragma once

#include <string>

#include "targets/mesh/triangle_mesh.hpp"

namespace kinetix::targets {

/// Triangles of a PLY file (Turk 1994), ASCII or binary of either byte order, in the file's units: the
/// elements `vertex` with x, y, z and `face` with a list vertex_indices or vertex_index. Everything else is
/// skipped. Polygons are cut into fans.
/// @param bytes the whole file
/// @throws InvalidInput without a file as place: a header that does not say this, counts beyond what the
/// bytes can hold (found before anything is allocated) or beyond the limits of mesh_file.hpp, an index of a
/// vertex that is not there, a vertex that is not finite, data that end early
TriangleMesh parse_ply(const std::string& bytes);

}  // namespace kinetix::targets
