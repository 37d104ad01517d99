#pragma once

#include "app/cad/product.hpp"
#include "app/cad/solid_bytes.hpp"
#include "model/solids/polyhedron.hpp"

namespace kinetix::app::cad {

// OpenCASCADE writes STEP. It takes longer to load than many runs of the program, so it is in a separate module. The
// first call loads that module, kinetix-cad.so.

/// Loads kinetix-cad.so now. @throws std::runtime_error if it is missing
void load();

/// Returns a STEP file (AP214) of the product. The same product always gives the same bytes.
/// @throws std::runtime_error if the module is missing, or if the pieces of a shape do not form one solid
std::string step_text(const Product& product);

/// Reads all solids of a STEP file, in mm, each at its place in the assembly. kinetix-read-step reads the file in a
/// separate process (app/io/reader_program.hpp). One flipped bit in six crashes OpenCASCADE, which uses null handles
/// before it checks them.
/// @throws InvalidInput without a place for a file that is damaged or too large.
/// @throws std::runtime_error if kinetix-read-step is missing
std::vector<FoundSolid> solids_of_step(const std::string& file);

}  // namespace kinetix::app::cad

namespace kinetix::app {

/// Returns a solid as binary STL, with coordinates rounded to float. @param name title in the header
std::string stl_text(const std::string& name, const model::Polyhedron& solid);

}  // namespace kinetix::app
