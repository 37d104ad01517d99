#pragma once

#include "app/files/design_file.hpp"
#include "app/io/atomic_file.hpp"

namespace kinetix::app {

/// Returns every key of a design of imported bodies, as `import` writes it: assembly.schema.json.
const targets::KeyTable& bodies_keys();

/// Whether a document is a design of bodies: its `structure` has the key `bodies` or `cuts`.
bool lists_bodies(const targets::Node& root);

/// Reads a design of imported bodies, with a mesh file for each body and soft part, relative to the design. Also reads
/// a sheet with cuts (read_cuts).
/// @throws InvalidInput for all that the keys do not allow, names that are missing or used twice, and meshes that are
/// not solids
Design read_bodies(const targets::Node& root);

/// Returns the text of the design's file. @pre design.structure.assembly()
std::string bodies_text(const Design& design);

/// Returns design.yaml of any design, with the meshes of its imported bodies, coordinates rounded to float, or with the
/// drawing of its cuts.
std::vector<NamedContent> design_files(const Design& design);

}  // namespace kinetix::app
