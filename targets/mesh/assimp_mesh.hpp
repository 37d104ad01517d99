#pragma once

#include <string>

#include "targets/mesh/triangle_mesh.hpp"

namespace kinetix::targets {

/// Triangles of an OBJ or STL file by assimp, not joined, in the file's units.
/// @param bytes what strict_obj or strict_stl gave: assimp may crash or hang on damaged files
/// @param format "obj" or "stl"
/// @throws InvalidInput without a place for what assimp refuses
TriangleMesh assimp_mesh(const std::string& bytes, const std::string& format);

}  // namespace kinetix::targets
