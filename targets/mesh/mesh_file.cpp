#include "targets/mesh/mesh_file.hpp"

#include <filesystem>

#include "model/base/invalid_input.hpp"
#include "targets/document/text_file.hpp"
#include "targets/document/wording.hpp"
#include "targets/mesh/assimp_mesh.hpp"
#include "targets/mesh/ply_mesh.hpp"
#include "targets/mesh/strict_mesh.hpp"

namespace kinetix::targets {
namespace {

// End of messages about files without a mesh.
constexpr const char* wanted = "; give an OBJ, STL or PLY file of triangles or polygons";

TriangleMesh parse(const std::string& bytes, const std::string& ending) {
  if (ending == ".ply") return parse_ply(bytes);
  if (ending == ".obj") {
    const std::string strict = strict_obj(bytes);
    return strict.find('f') == std::string::npos ? TriangleMesh() : assimp_mesh(strict, "obj");
  }
  const std::string strict = strict_stl(bytes);
  return strict.size() == empty_stl_bytes ? TriangleMesh() : assimp_mesh(strict, "stl");
}

void check(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw InvalidInput(std::string("has no triangles") + wanted);
  if (mesh.triangles.size() > max_mesh_triangles)
    throw InvalidInput("has too many triangles; at most " + std::to_string(max_mesh_triangles) +
                       " are allowed; thin the mesh out");
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (!mesh.vertices[v].allFinite())
      throw InvalidInput("vertex " + std::to_string(v + 1) + " has a coordinate that is not a finite number");
}

}  // namespace

TriangleMesh read_mesh(const std::string& file) {
  const std::string ending = lower_case(std::filesystem::path(file).extension().string());
  if (ending != ".obj" && ending != ".stl" && ending != ".ply")
    throw InvalidInput("has no known mesh format, judged by its ending" + std::string(wanted), {file});
  const std::string bytes = read_bytes(file, max_mesh_bytes);
  try {
    const TriangleMesh mesh = parse(bytes, ending);
    check(mesh);
    return joined(mesh);
  } catch (const InvalidInput& e) {
    throw InvalidInput(e.reason(), {file, e.place().line, e.place().column, {}});
  }
}

}  // namespace kinetix::targets
