#pragma once

#include <memory>

#include "app/files/design_file.hpp"
#include "app/run/scene.hpp"

namespace kinetix::app {

/// A design as it is, nothing to search for.
/// @param model exact: one state of the closed form; equilibrium: of the design's elastic hinges, followed
/// from flat to its drive, the closed form of the same drive beside it where a family fits; bullet: the
/// physics run, compared with the equilibrium where hinges are elastic, else with the exact state where a
/// family fits; elsewhere there is none, and the run is judged by its own closure alone
std::unique_ptr<Scene> make_scene(Design design, Model model);

}  // namespace kinetix::app
