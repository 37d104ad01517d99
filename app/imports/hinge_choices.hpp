#pragma once

#include <string>

#include "model/assembly/assembly.hpp"
#include "targets/document/keys.hpp"

namespace kinetix::app {

/// Keys of the side file of an import.
const targets::KeyTable& hinge_choice_keys();

/// What a side file says of hinges: `hinges: [{hinge: NAME, axis: [x, y, z]}, {bodies: [A, B], axis: ...}]`, and `towards: [x, y, z]` for all
/// ambiguous ones that it does not name. @throws InvalidInput with the place in the file
model::HingeChoices read_hinge_choices(const std::string& file);

}  // namespace kinetix::app
