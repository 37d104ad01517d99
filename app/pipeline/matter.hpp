#pragma once

#include "app/run/scene.hpp"

namespace kinetix::app {

/// Whether the goal was searched for by closed form and its file says what elastic hinges are made of.
bool is_of_matter(const Scene& scene, const Run& run);

/// Takes a design that meets its goal exactly to the equilibrium of its elastic hinges, from flat by its drive, and
/// brings that onto the goal (optim/matter/compensate.hpp). The run then shows the equilibrium of the new design, as
/// the path from flat comes to it. Without an equilibrium the exact state stays, and the goal says why it is not met.
/// @pre judged, is_of_matter
void settle_in_matter(Run& run, const Scene& scene, const RunOptions& options);

}  // namespace kinetix::app
