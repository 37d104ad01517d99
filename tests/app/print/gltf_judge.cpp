#include "tests/app/print/gltf_judge.hpp"

#include <assimp/scene.h>

#include <assimp/Importer.hpp>

namespace kinetix::testing {
namespace {

int with_meshes(const aiNode& node) {
  int count = node.mNumMeshes > 0;
  for (unsigned k = 0; k < node.mNumChildren; ++k) count += with_meshes(*node.mChildren[k]);
  return count;
}

}  // namespace

GltfVerdict read_gltf(const std::string& file) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file, 0);
  GltfVerdict verdict;
  if (!scene) {
    verdict.error = importer.GetErrorString();
    return verdict;
  }
  verdict.meshes = static_cast<int>(scene->mNumMeshes);
  verdict.nodes_with_meshes = with_meshes(*scene->mRootNode);
  verdict.materials = static_cast<int>(scene->mNumMaterials);
  verdict.animations = static_cast<int>(scene->mNumAnimations);
  if (verdict.animations == 0) return verdict;
  const aiAnimation& motion = *scene->mAnimations[0];
  verdict.moved_nodes = static_cast<int>(motion.mNumChannels);
  verdict.seconds = motion.mDuration / (motion.mTicksPerSecond > 0 ? motion.mTicksPerSecond : 1);
  return verdict;
}

}  // namespace kinetix::testing
