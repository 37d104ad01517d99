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

/// Triangles of an OBJ or STL file by assimp, not joined, in the file's units.
/// @param bytes what strict_obj or strict_stl gave: assimp may crash or hang on damaged files
/// @param format "obj" or "stl"
/// @throws InvalidInput without a place for what assimp refuses
TriangleMesh assimp_mesh(const std::string& bytes, const std::string& format);

/// Rewrites an OBJ file as its vertices and faces and nothing else: indices counted from 1, continued lines joined.
/// Assimp then reads no other file and no missing vertex. Faces of fewer than three corners (lines, points) are left
/// out.
/// @throws InvalidInput with line and column as place for a vertex without three finite numbers, and for a corner that
/// is not the index of a vertex. Faces over the limits of mesh_file.hpp also throw.
std::string strict_obj(const std::string& bytes);

/// Bytes of a binary STL file without triangles: 80 of title and 4 for their number.
inline constexpr std::size_t empty_stl_bytes = 84;
/// Rewrites an STL file, binary or ASCII, as a binary one whose length agrees with its content. Bytes after the last
/// triangle of a binary file are cut off.
/// @throws InvalidInput with line and column as place for text that is not facets of three finite vertices or ends
/// early. Binary files that end early, and triangles over the limit of mesh_file.hpp, throw without a place.
std::string strict_stl(const std::string& bytes);

}  // namespace kinetix::targets
