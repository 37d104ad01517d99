#pragma once

#include <string>
#include <vector>

#include "app/files/design_file.hpp"
#include "app/io/atomic_file.hpp"

namespace kinetix::app {

/// Every key of a design of imported bodies, as `import` writes it: assembly.schema.json.
const targets::KeyTable& bodies_keys();

/// Whether a document is one: its `structure` has the key `bodies`.
bool lists_bodies(const targets::Node& root);

/// A design of imported bodies, with a mesh beside it for each of them and each soft part.
/// @throws InvalidInput for whatever the keys do not allow, names that are not there or there twice, and meshes that are no solids
Design read_bodies(const targets::Node& root);

/// Its text. @pre design.structure.assembly()
std::string bodies_text(const Design& design);

/// design.yaml of any design, and the meshes of imported bodies beside it, coordinates rounded to float.
std::vector<NamedContent> design_files(const Design& design);

}  // namespace kinetix::app
