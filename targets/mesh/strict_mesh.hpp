#pragma once

#include <cstddef>
#include <string>

namespace kinetix::targets {

/// The vertices and faces of an OBJ file and nothing else: indices counted from 1, continued lines joined.
/// What assimp then reads names no other file and no vertex that is not there. Faces of fewer than three
/// corners (lines, points) are left out.
/// @throws InvalidInput with line and column as place: a vertex without three finite numbers, a corner that
/// is no index of a vertex, faces over the limits of mesh_file.hpp
std::string strict_obj(const std::string& bytes);

/// Bytes of a binary STL file without triangles: 80 of title and 4 for their number.
inline constexpr std::size_t empty_stl_bytes = 84;
/// An STL file, binary or ASCII, as a binary one whose length agrees with what it holds. Bytes after the last
/// triangle of a binary file are cut off.
/// @throws InvalidInput with line and column as place for text that is not facets of three finite vertices or
/// ends early; without a place for binary files that end early, and for triangles over the limit of
/// mesh_file.hpp
std::string strict_stl(const std::string& bytes);

}  // namespace kinetix::targets
