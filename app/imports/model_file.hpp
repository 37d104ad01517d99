#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/solids/polyhedron.hpp"

namespace kinetix::app {

/// Triangles of a model that a file keeps together: an object, a group or a material's share of one.
struct FoundMesh {
  std::string name;        ///< as the file has it; empty: none
  std::string material;    ///< its name, or its colour as #RRGGBB; empty: none
  model::Polyhedron soup;  ///< in the file's unit, later mm
};

/// What a file of a 3D model holds.
struct ModelFile {
  std::string file;
  std::vector<FoundMesh> meshes;
  std::optional<double> unit_mm = {};  ///< length of its unit, mm, where the file says so
};

/// More than any printer's job; a limit keeps damage and hostile files off the memory.
inline constexpr std::size_t max_model_triangles = 1'000'000;

/// A 3MF, STEP, glTF (glb), OBJ, PLY or STL file, told apart by its ending.
/// @throws InvalidInput with the file as place: missing, unreadable, damaged, of another format, too large
ModelFile read_model_file(const std::string& file);

/// Each of the formats, of its bytes; `file` serves for messages.
ModelFile read_threemf(const std::string& bytes, const std::string& file);
ModelFile read_groups_of_obj(const std::string& bytes, const std::string& file);
ModelFile read_glb(const std::string& bytes, const std::string& file);
/// The library reads named files only.
ModelFile read_step(const std::string& file);

}  // namespace kinetix::app
