#pragma once

#include <string>

namespace kinetix::testing {

/// What assimp's reader finds in a glTF file.
struct GltfVerdict {
  std::string error;  ///< why it cannot be read; empty where it can
  int meshes = 0, nodes_with_meshes = 0, materials = 0;
  int animations = 0, moved_nodes = 0;  ///< of the first animation
  double seconds = 0;                   ///< it lasts
};

GltfVerdict read_gltf(const std::string& file);

}  // namespace kinetix::testing
