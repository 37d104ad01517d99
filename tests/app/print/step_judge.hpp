#pragma once

#include <string>

namespace kinetix::testing {

/// What OpenCASCADE's reader finds in a STEP file.
struct StepVerdict {
  int solids = 0;
  bool valid = false;  ///< by BRepCheck
  double volume_mm3 = 0;
};

StepVerdict read_step(const std::string& file);

}  // namespace kinetix::testing
