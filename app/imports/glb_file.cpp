#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>

#include "app/imports/model_file.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::app {
namespace {

constexpr double metre_mm = 1000;  // mm: glTF is in metres

/// y up, as glTF has it, to z up.
Eigen::Affine3d upright() {
  Eigen::Affine3d out = Eigen::Affine3d::Identity();
  out.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return out;
}

Eigen::Affine3d affine(const aiMatrix4x4& m) {
  Eigen::Affine3d out = Eigen::Affine3d::Identity();
  for (unsigned r = 0; r < 3; ++r)
    for (unsigned c = 0; c < 4; ++c) out.matrix()(r, c) = m[r][c];
  return out;
}

Eigen::Affine3d world_of(const aiNode* node) {
  Eigen::Affine3d out = Eigen::Affine3d::Identity();
  for (; node != nullptr; node = node->mParent) out = affine(node->mTransformation) * out;
  return upright() * out;
}

/// Where bones hold a mesh: what they carry each corner to. The mesh's own place does not count then.
void add_skinned_points(const aiScene& scene, const aiMesh& mesh, FoundMesh& found) {
  found.soup.points.assign(mesh.mNumVertices, Eigen::Vector3d::Zero());
  for (unsigned b = 0; b < mesh.mNumBones; ++b) {
    const aiBone& bone = *mesh.mBones[b];
    const Eigen::Affine3d X = world_of(scene.mRootNode->FindNode(bone.mName)) * affine(bone.mOffsetMatrix);
    for (unsigned k = 0; k < bone.mNumWeights; ++k) {
      const unsigned v = bone.mWeights[k].mVertexId;
      if (v >= mesh.mNumVertices) continue;
      const aiVector3D& p = mesh.mVertices[v];
      found.soup.points[v] += bone.mWeights[k].mWeight * (X * Eigen::Vector3d(p.x, p.y, p.z));
    }
  }
}

void add_points(const aiMesh& mesh, const Eigen::Affine3d& X, FoundMesh& found) {
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    const aiVector3D& p = mesh.mVertices[v];
    found.soup.points.emplace_back(X * Eigen::Vector3d(p.x, p.y, p.z));
  }
}

std::string material_name(const aiScene& scene, const aiMesh& mesh) {
  aiString name;
  if (mesh.mMaterialIndex >= scene.mNumMaterials) return {};
  scene.mMaterials[mesh.mMaterialIndex]->Get(AI_MATKEY_NAME, name);
  return name.C_Str();
}

void add_meshes(const aiScene& scene, const aiNode& node, const Eigen::Affine3d& above, ModelFile& out) {
  const Eigen::Affine3d X = above * affine(node.mTransformation);
  for (unsigned k = 0; k < node.mNumMeshes; ++k) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[k]];
    FoundMesh found{
        node.mName.length > 0 ? node.mName.C_Str() : mesh.mName.C_Str(), material_name(scene, mesh), {}};
    if (mesh.HasBones())
      add_skinned_points(scene, mesh, found);
    else
      add_points(mesh, X, found);
    for (unsigned f = 0; f < mesh.mNumFaces; ++f)
      if (mesh.mFaces[f].mNumIndices == 3) {
        std::array<int, 3> t;
        for (int c = 0; c < 3; ++c) t[c] = static_cast<int>(mesh.mFaces[f].mIndices[c]);
        if (X.linear().determinant() < 0) std::swap(t[1], t[2]);
        found.soup.triangles.push_back(t);
      }
    out.meshes.push_back(std::move(found));
  }
  for (unsigned k = 0; k < node.mNumChildren; ++k) add_meshes(scene, *node.mChildren[k], X, out);
}

}  // namespace

ModelFile read_glb(const std::string& bytes, const std::string& file) {
  if (bytes.size() < 12 || std::memcmp(bytes.data(), "glTF", 4) != 0)
    throw InvalidInput("is not a binary glTF file", {file});
  Assimp::Importer importer;
  const aiScene* scene =
      importer.ReadFileFromMemory(bytes.data(), bytes.size(), aiProcess_Triangulate, "glb");
  if (scene == nullptr || scene->mRootNode == nullptr)
    throw InvalidInput("is damaged: " + std::string(importer.GetErrorString()), {file});
  ModelFile out{file, {}, metre_mm};
  add_meshes(*scene, *scene->mRootNode, upright(), out);
  return out;
}

}  // namespace kinetix::app
