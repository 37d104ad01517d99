#pragma once

namespace kinetix::app {

/// What an equilibrium path asks of who drives the sheet, and of its hinges.
struct HingeLoads {
  bool reached = false;  ///< whether the path came to its goal
  double force_N = 0;  ///< largest on the way; of a driven hinge with the lever of a cell edge; 0 of springs
  double strain = 0;   ///< largest of a hinge that is made as a block or film, at the goal; ratio
};

}  // namespace kinetix::app
