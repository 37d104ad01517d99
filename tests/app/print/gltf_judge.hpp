#pragma once

#include <string>

namespace kinetix::testing {

/// Findings of assimp's reader in a glTF file.
struct GltfVerdict {
  std::string error;  ///< read error; empty: none
  int meshes = 0, nodes_with_meshes = 0, materials = 0;
  int animations = 0, moved_nodes = 0;  ///< `moved_nodes`: by the first animation
  double seconds = 0;                   ///< duration of that animation
};

GltfVerdict read_gltf(const std::string& file);

}  // namespace kinetix::testing
