#include "app/imports/model_file.hpp"

#include <filesystem>

#include "model/base/invalid_input.hpp"
#include "targets/document/text_file.hpp"
#include "targets/document/wording.hpp"
#include "targets/mesh/mesh_file.hpp"

namespace kinetix::app {
namespace {

constexpr double max_coordinate =
    1e9;  // of a point, in the file's unit: a thousand kilometres of millimetres

ModelFile one_mesh(const std::string& file) {
  const targets::TriangleMesh mesh = targets::read_mesh(file);
  ModelFile out{file, {}};
  FoundMesh& found = out.meshes.emplace_back();
  found.soup.points = mesh.vertices;
  found.soup.triangles = mesh.triangles;
  return out;
}

ModelFile read_by_ending(const std::string& file) {
  const std::string ending = targets::lower_case(std::filesystem::path(file).extension().string());
  if (ending == ".step" || ending == ".stp") return read_step(file);
  if (ending == ".stl" || ending == ".ply") return one_mesh(file);
  const auto bytes = [&] { return targets::read_bytes(file, targets::max_mesh_bytes); };
  if (ending == ".3mf") return read_threemf(bytes(), file);
  if (ending == ".obj") return read_groups_of_obj(bytes(), file);
  if (ending == ".glb") return read_glb(bytes(), file);
  std::error_code failure;  // of a name that no file can have: then there is none
  if (!std::filesystem::exists(file, failure)) throw InvalidInput("no such file", {file});
  if (std::filesystem::is_directory(file, failure))
    throw InvalidInput(
        "is a folder without vertices.txt; give a folder of tiles, or a 3MF, STEP, GLB, OBJ, PLY or STL file",
        {file});
  throw InvalidInput(
      "has no known model format, judged by its ending; give a 3MF, STEP, GLB, OBJ, PLY or STL file", {file});
}

}  // namespace

ModelFile read_model_file(const std::string& file) {
  ModelFile model = read_by_ending(file);
  std::size_t triangles = 0;
  for (const FoundMesh& mesh : model.meshes) {
    triangles += mesh.soup.triangles.size();
    for (const Eigen::Vector3d& p : mesh.soup.points)
      if (!(p.cwiseAbs().maxCoeff() <= max_coordinate))
        throw InvalidInput("has a point whose coordinates are no numbers within a thousand million", {file});
  }
  if (triangles == 0) throw InvalidInput("has no triangles", {file});
  if (triangles > max_model_triangles)
    throw InvalidInput("has " + std::to_string(triangles) + " triangles; at most " +
                           std::to_string(max_model_triangles) + " are allowed; thin the model out",
                       {file});
  return model;
}

}  // namespace kinetix::app
