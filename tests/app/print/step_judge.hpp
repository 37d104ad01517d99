#pragma once

#include <map>
#include <string>

namespace kinetix::testing {

/// What OpenCASCADE's own reader finds in a STEP file.
struct StepVerdict {
  bool valid = false;
  int solids = 0, shells = 0;
  int open_shells = 0;  ///< with edges that bound one face only
  double volume_mm3 = 0;
  std::map<std::string, int> names;    ///< of the assembly's parts: how many begin with this word
  std::map<std::string, int> colours;  ///< of these parts' shapes, as #RRGGBB of the screen: how many have it
};

StepVerdict read_step(const std::string& file);

}  // namespace kinetix::testing
