#pragma once

#include "app/run/scene.hpp"

namespace kinetix::app {

/// The one way through the program: solve -> plan -> state -> verify -> evidence.
/// @throws InvalidInput for a target that leaves nothing to search, and a design that its model does not fit
Run run_scene(const Scene& scene, const RunOptions& options);

}  // namespace kinetix::app
