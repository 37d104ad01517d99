#include "targets/mesh/assimp_mesh.hpp"

#include "model/base/invalid_input.hpp"
#include "model/base/loaded_module.hpp"
#include "targets/mesh/assimp_module.hpp"

namespace kinetix::targets {

TriangleMesh assimp_mesh(const std::string& bytes, const std::string& format) {
  TriangleMesh mesh;
  std::string refusal;
  reinterpret_cast<decltype(&kinetix_assimp_mesh)>(
      model::module_function("kinetix-mesh.so", "kinetix_assimp_mesh"))(bytes, format, mesh, refusal);
  if (!refusal.empty()) throw InvalidInput("is damaged: " + refusal);
  return mesh;
}

}  // namespace kinetix::targets
