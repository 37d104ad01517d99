#pragma once

#include <string>
#include <vector>

#include "app/cad/found_solid.hpp"
#include "app/cad/product.hpp"

namespace kinetix::app::cad {

// OpenCASCADE, which writes and reads STEP, takes longer to load than many a run of the program: it stands in a module of
// its own, kinetix-cad.so, loaded by the first call.

/// Loads that module now. @throws std::runtime_error where it is missing
void load();

/// A STEP file (AP214) of the product: the same bytes each time.
/// @throws std::runtime_error where the module is missing, or where pieces of a shape are no solid together
std::string step_text(const Product& product);

/// All solids of a STEP file, in mm; of its assemblies at their places.
/// @throws std::runtime_error where the module is missing, or with what is wrong with the file
std::vector<FoundSolid> solids_of_step(const std::string& file);

}  // namespace kinetix::app::cad
