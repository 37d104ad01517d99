#pragma once

#include <string>

#include "targets/mesh/triangle_mesh.hpp"

namespace kinetix::targets {

/// Reads the triangles of a PLY file (Turk 1994), ASCII or binary of either byte order, in the file's units. It reads
/// the elements `vertex` with x, y, z and `face` with a list vertex_indices or vertex_index, and skips everything
/// else. Polygons are cut into fans.
/// @param bytes the whole file.
/// @throws InvalidInput without a file as place for a header without these elements, or data that end early. Counts
/// beyond what the bytes can hold throw before anything is allocated. Counts beyond the limits of mesh_file.hpp, an
/// index of a missing vertex, and a vertex that is not finite also throw.
TriangleMesh parse_ply(const std::string& bytes);

/// Reads the triangles of an OFF file in text, in the file's units. Polygons become fans of triangles. Colours,
/// normals and texture coordinates are ignored. https://www.geomview.org/docs/html/OFF.html
/// @throws InvalidInput with line and column as place for anything else, and for the limits of mesh_file.hpp
TriangleMesh parse_off(const std::string& bytes);

}  // namespace kinetix::targets
