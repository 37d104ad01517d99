#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>

#include "targets/mesh/mesh_formats.hpp"

namespace kinetix::targets {
namespace {

void append(const aiMesh& part, TriangleMesh& mesh) {
  const int first = static_cast<int>(mesh.vertices.size());
  for (unsigned v = 0; v < part.mNumVertices; ++v) {
    const aiVector3D& p = part.mVertices[v];
    mesh.vertices.emplace_back(p.x, p.y, p.z);
  }
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    if (face.mNumIndices != 3) continue;
    Triangle& triangle = mesh.triangles.emplace_back();
    for (int k = 0; k < 3; ++k) triangle[k] = first + static_cast<int>(face.mIndices[k]);
  }
}

}  // namespace

}  // namespace kinetix::targets

void kinetix_assimp_mesh(const std::string& bytes, const std::string& format,
                         kinetix::targets::TriangleMesh& mesh, std::string& refusal) {
  Assimp::Importer importer;
  const aiScene* scene =
      importer.ReadFileFromMemory(bytes.data(), bytes.size(), aiProcess_Triangulate, format.c_str());
  if (scene == nullptr) {
    refusal = importer.GetErrorString();
    return;
  }
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) kinetix::targets::append(*scene->mMeshes[m], mesh);
}
