#pragma once

#include <map>
#include <string>

namespace kinetix::testing {

/// Findings of OpenCASCADE's reader in a STEP file.
struct StepVerdict {
  bool valid = false;
  int solids = 0, shells = 0;
  int open_shells = 0;  ///< shells with edges that bound one face only
  double volume_mm3 = 0;
  std::map<std::string, int> names;    ///< number of the assembly's parts by the first word of their names
  std::map<std::string, int> colours;  ///< number of these parts' shapes by colour, as #RRGGBB of the screen
};

StepVerdict read_step(const std::string& file);

}  // namespace kinetix::testing
