#pragma once

#include <string>
#include <vector>

#include "app/cad/product.hpp"
#include "app/cad/solid_bytes.hpp"

namespace kinetix::app::cad {

// OpenCASCADE, which writes STEP, takes longer to load than many a run of the program: it stands in a module of
// its own, kinetix-cad.so, loaded by the first call.

/// Loads that module now. @throws std::runtime_error where it is missing
void load();

/// A STEP file (AP214) of the product: the same bytes each time.
/// @throws std::runtime_error where the module is missing, or where pieces of a shape are no solid together
std::string step_text(const Product& product);

/// All solids of a STEP file, in mm; of its assemblies at their places. Read by kinetix-read-step, a separate process
/// (app/io/reader_program.hpp): one flipped bit in six crashes OpenCASCADE, which uses null handles before it checks them.
/// @throws InvalidInput without a place for a file that is damaged or too large
/// @throws std::runtime_error where kinetix-read-step is missing
std::vector<FoundSolid> solids_of_step(const std::string& file);

}  // namespace kinetix::app::cad
