#pragma once

#include <string>

namespace kinetix::testing {

/// Findings of lib3mf's reader in a 3MF file.
struct ThreemfVerdict {
  bool is_read = false;
  int warnings = 0, objects = 0, triangles = 0;
  bool manifold = false;  ///< every mesh is manifold and oriented
};

ThreemfVerdict read_threemf(const std::string& file);

}  // namespace kinetix::testing
