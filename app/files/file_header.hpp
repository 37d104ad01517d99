#pragma once

#include "targets/document/section.hpp"

namespace kinetix::app {

/// Returns the keys of a whole file: `kinetix` and `name`, which every file may have, before its own.
targets::KeyTable file_keys(std::vector<targets::Key> own);

/// Rejects a result.json, which is not an input, and names its design. @throws InvalidInput for a result.json
void refuse_result(const targets::Node& root);

/// Checks the `kinetix:` key that every file starts with. @throws InvalidInput when it is missing or another
/// version
void check_version(const targets::Section& root);

/// Returns the root section of a file by its keys. @throws InvalidInput as Section and check_version()
targets::Section read_root(const targets::Node& node, const targets::KeyTable& keys);

/// Reads the `name:` key. The default is the file's name without its ending, with `_` for characters that a name may
/// not have. It names the folder of results: 1 to 100 letters, digits, `_`, `-` and `.`, not starting with a point.
/// @throws InvalidInput for any other name
std::string read_name(const targets::Section& root);
/// Reads such a name for anything that names a file or folder. No other path can then be written.
std::string usable_name(const targets::Node& node);

}  // namespace kinetix::app
