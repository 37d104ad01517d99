#pragma once

#include <cstddef>
#include <string>

namespace kinetix::targets {

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
