#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "targets/document/document.hpp"
#include "targets/mesh/triangle_mesh.hpp"

namespace kinetix::targets {

/// Largest file, bytes (256 MiB): the allowed triangles take 143 MiB in a binary STL file.
inline constexpr std::size_t max_mesh_bytes = 256 << 20;
/// Most triangles: their edges are under half a millimetre on a whole head. More would only cost time.
inline constexpr std::size_t max_mesh_triangles = 3'000'000;
/// Most corners of one face of a file: larger fans are not polygons that a program would write, but damage.
inline constexpr std::size_t max_face_corners = 256;

/// Formats of meshes that the program reads, for messages and tables of keys. STEP, 3MF and GLB need a reader of another
/// room (MeshReader).
inline constexpr const char* mesh_formats = "3MF, GLB, OBJ, OFF, PLY, STEP or STL";

/// Reads the triangles of an OBJ, OFF, STL or PLY file (distinguished by its ending), in the file's units and axes.
/// Polygons are cut into triangles, and equal vertices are joined. Lines and points, normals, colours, groups and
/// materials are ignored.
/// @throws InvalidInput with the file, and for text formats the line, as place. Causes are a missing or unreadable
/// file, another format, over 256 MiB or 3 million triangles, and no triangles. Damaged files (cut short, indices of
/// missing vertices) and vertices that are not finite also throw.
TriangleMesh read_mesh(const std::string& file);

/// Mesh of a file, in the file's units.
struct FileMesh {
  TriangleMesh mesh;
  std::optional<double> unit_mm = {};  ///< mm in one of its units; empty: the file does not name its unit
};

/// Function that reads a mesh file, as read_mesh does.
using MeshReader = std::function<FileMesh(const std::string& file)>;

/// Reads a file by read_mesh.
inline FileMesh read_plain_mesh(const std::string& file) { return {read_mesh(file)}; }

/// Reads the file that a key names, relative to the document's folder. @throws InvalidInput at the key's place
FileMesh read_mesh_at(const Node& key, const MeshReader& read);

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
