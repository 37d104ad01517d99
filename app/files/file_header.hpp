#pragma once

#include <string>
#include <vector>

#include "targets/document/section.hpp"

namespace kinetix::app {

/// The keys of a whole file: `kinetix` and `name`, which every file may hold, before its own.
targets::KeyTable file_keys(std::vector<targets::Key> own);

/// Says of a result.json that it is none of these files, and which is. @throws InvalidInput for one
void refuse_result(const targets::Node& root);

/// Checks the `kinetix:` key that every file starts with. @throws InvalidInput when it is missing or another
/// version
void check_version(const targets::Section& root);

/// The whole of a file by its keys. @throws InvalidInput as Section and check_version()
targets::Section read_root(const targets::Node& node, const targets::KeyTable& keys);

/// The `name:` key, by default the file's name without its ending (with `_` for what a name may not hold). It
/// names the folder of results: 1 to 100 letters, digits, `_`, `-` and `.`, not starting with a point.
/// @throws InvalidInput for any other name
std::string read_name(const targets::Section& root);
/// Such a name: of anything that a file or folder is called by, so that none is written elsewhere.
std::string usable_name(const targets::Node& node);

}  // namespace kinetix::app
