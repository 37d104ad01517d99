#pragma once

#include <cstddef>
#include <string>

#include "targets/mesh/triangle_mesh.hpp"

namespace kinetix::targets {

/// Bytes, 256 MiB: the triangles that are allowed take 143 MiB in a binary STL file.
inline constexpr std::size_t max_mesh_bytes = 256 << 20;
/// Triangles: their edges are under half a millimetre on a whole head. More would only cost time.
inline constexpr std::size_t max_mesh_triangles = 3'000'000;
/// Corners of one face of a file: fans of more are no polygons that a program would write, but damage.
inline constexpr std::size_t max_face_corners = 256;

/// Triangles of an OBJ, STL or PLY file (told apart by its ending), in the file's units and axes. Polygons
/// are cut into triangles, equal vertices joined, lines and points, normals, colours, groups and materials
/// ignored.
/// @throws InvalidInput with the file, and for text formats the line, as place: missing, unreadable, of
/// another format, over 256 MiB or 3 million triangles, damaged (cut short, indices of vertices that are not
/// there), a vertex that is not finite, no triangles
TriangleMesh read_mesh(const std::string& file);

}  // namespace kinetix::targets
