#pragma once

#include <string>

namespace kinetix::app {

/// What an equilibrium path asks of who drives the sheet, and of its hinges.
struct HingeLoads {
  bool reached = false;  ///< whether the path came to its goal
  double force_N = 0;  ///< largest on the way; of a driven hinge with the lever of a cell edge; 0 of springs
  bool by_lever = false;  ///< it is of a driven hinge
  double strain = 0;      ///< largest of a hinge that is made as a block or film, at the goal; ratio
};

/// Of the force, in words: empty where it is one, as of plates.
inline std::string lever_words(const HingeLoads& loads) {
  return loads.by_lever ? " at the lever of a cell edge" : "";
}

}  // namespace kinetix::app
