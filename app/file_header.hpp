#pragma once

#include <string>

#include "targets/document.hpp"

namespace kinetix {

/// Checks the `kinetix:` key that every file starts with. @throws InvalidInput when it is missing or another
/// version
void check_version(const Node& root);

/// The `name:` key, by default the file's name without its ending (with `_` for what a name may not hold). It
/// names the folder of results: 1 to 100 letters, digits, `_`, `-` and `.`, not starting with a point.
/// @throws InvalidInput for any other name
std::string read_name(const Node& root);

}  // namespace kinetix
