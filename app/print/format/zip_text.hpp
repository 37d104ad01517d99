#pragma once

#include <string>
#include <vector>

#include "app/run/goal_outcome.hpp"

namespace kinetix::app {

/// A zip archive with these files, compressed; always the same bytes for the same files.
/// @throws std::runtime_error where the library fails
std::string zip_text(const std::vector<NamedContent>& files);

/// A file of an archive; empty where there is no such file or archive.
std::string text_in_zip(const std::string& archive, const std::string& name);

}  // namespace kinetix::app
