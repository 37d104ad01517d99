#include "app/cad/step.hpp"
#include "app/imports/model_file.hpp"
#include "model/base/invalid_input.hpp"
#include "targets/document/text_file.hpp"
#include "targets/mesh/mesh_file.hpp"

namespace kinetix::app {

ModelFile read_step(const std::string& file) {
  const std::string start = targets::read_bytes(file, targets::max_mesh_bytes).substr(0, 200);
  if (start.find("ISO-10303-21") == std::string::npos)
    throw InvalidInput("is not a STEP file: it does not start with ISO-10303-21", {file});
  ModelFile out{file, {}, 1};
  try {
    for (cad::FoundSolid& solid : cad::solids_of_step(file))
      out.meshes.push_back({std::move(solid.name),
                            std::move(solid.colour),
                            {std::move(solid.points), std::move(solid.triangles)}});
  } catch (const InvalidInput& e) {
    throw InvalidInput(e.reason(), {file});
  }
  if (out.meshes.empty()) throw InvalidInput("has no solids; give a STEP file of solid bodies", {file});
  return out;
}

}  // namespace kinetix::app
