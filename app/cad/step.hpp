#pragma once

#include <string>

#include "app/cad/assembly.hpp"

namespace kinetix::app::cad {

/// A STEP file (AP214) of the assembly: the same bytes each time. OpenCASCADE, which writes it, takes longer to load than
/// many a run of the program: it stands in a module of its own, kinetix-cad.so, loaded by the first call.
/// @throws std::runtime_error where the module is missing, or where pieces of a shape are no solid together
std::string step_text(const Assembly& assembly);

}  // namespace kinetix::app::cad
