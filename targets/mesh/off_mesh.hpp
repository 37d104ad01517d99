#pragma once

#include <string>

#include "targets/mesh/triangle_mesh.hpp"

namespace kinetix::targets {

/// Reads the triangles of an OFF file in text, in the file's units. Polygons become fans of triangles. Colours,
/// normals and texture coordinates are ignored. https://www.geomview.org/docs/html/OFF.html
/// @throws InvalidInput with line and column as place for anything else, and for the limits of mesh_file.hpp
TriangleMesh parse_off(const std::string& bytes);

}  // namespace kinetix::targets
