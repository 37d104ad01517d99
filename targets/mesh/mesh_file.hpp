#pragma once

#include <cstddef>
#include <string>

#include "targets/mesh/triangle_mesh.hpp"

namespace kinetix::targets {

/// Largest file, bytes (256 MiB): the allowed triangles take 143 MiB in a binary STL file.
inline constexpr std::size_t max_mesh_bytes = 256 << 20;
/// Most triangles: their edges are under half a millimetre on a whole head. More would only cost time.
inline constexpr std::size_t max_mesh_triangles = 3'000'000;
/// Most corners of one face of a file: larger fans are not polygons that a program would write, but damage.
inline constexpr std::size_t max_face_corners = 256;

/// Reads the triangles of an OBJ, STL or PLY file (distinguished by its ending), in the file's units and axes.
/// Polygons are cut into triangles, and equal vertices are joined. Lines and points, normals, colours, groups and
/// materials are ignored.
/// @throws InvalidInput with the file, and for text formats the line, as place. Causes are a missing or unreadable
/// file, another format, over 256 MiB or 3 million triangles, and no triangles. Damaged files (cut short, indices of
/// missing vertices) and vertices that are not finite also throw.
TriangleMesh read_mesh(const std::string& file);

}  // namespace kinetix::targets
