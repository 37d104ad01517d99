#pragma once

#include "model/assembly/tiles.hpp"
#include "model/solids/polyhedron.hpp"
#include "targets/mesh/mesh_file.hpp"

namespace kinetix::app {

/// Triangles that a file keeps together: an object, a group or the part of one with the same material.
struct FoundMesh {
  std::string name;        ///< as the file has it; empty: none
  std::string material;    ///< its name, or its colour as #RRGGBB; empty: none
  model::Polyhedron soup;  ///< in the file's unit, later mm
  int object = 0;  ///< number of the file's object, from 1, whose materials are separate meshes; 0: none
};

/// Content of a file of a 3D model.
struct ModelFile {
  std::string file;
  std::vector<FoundMesh> meshes;
  std::optional<double> unit_mm = {};  ///< length of its unit, mm; empty: the file does not name one
};

/// More than in any print job. The limit keeps damaged and hostile files from filling memory.
inline constexpr std::size_t max_model_triangles = 1'000'000;

/// Reads a 3MF, STEP, glTF (glb), OBJ, OFF, PLY or STL file. Its ending decides which.
/// @throws InvalidInput with the file as place: missing, unreadable, damaged, of another format, too large
ModelFile read_model_file(const std::string& file);

/// Reads the triangles of a mesh file of any format of read_model_file, or the faces of a FOLD file. Parts of a model
/// are added to one mesh.
/// @throws InvalidInput as read_model_file and targets::read_mesh
targets::FileMesh read_mesh_file(const std::string& file);

/// Read one format from the bytes of a file; `file` is for messages.
ModelFile read_threemf(const std::string& bytes, const std::string& file);
ModelFile read_groups_of_obj(const std::string& bytes, const std::string& file);
ModelFile read_glb(const std::string& bytes, const std::string& file);
targets::TriangleMesh read_origami_faces(const std::string& bytes, const std::string& file);
/// Reads a STEP file by its name, since the library reads named files only.
ModelFile read_step(const std::string& file);

/// Checks whether a path is a folder of tiles: it holds vertices.txt.
bool is_tile_folder(const std::string& path);

/// Reads a folder of tiles in the form of PyKirigami (https://github.com/andy-qhjiang/PyKirigami).
/// vertices.txt has a tile per line: `x y z` of each corner.
/// constraints.txt has a joint per line: `tile corner tile corner [face]`, counted from 0. A face is 1 (bottom, the
/// default), 2 (top) or 3 (both). Faces 1 and 2 of the same corners in two lines mean 3.
/// target.txt may be missing. It has the form of vertices.txt.
/// @throws InvalidInput with file, line and column: missing or too large files, words that are not numbers, a wrong
/// count of numbers, faces other than 1 to 3. Also for a target with other corners than the tiles
model::TileSheet read_tiles(const std::string& folder);

/// Reads the faces of an OBJ file as tiles that turn about the vertices that they share. Empty for other files, if
/// faces share edges, as those of a surface or a solid do, and if none shares a vertex.
std::optional<model::TileSheet> read_tiles_of_obj(const std::string& file);

}  // namespace kinetix::app
