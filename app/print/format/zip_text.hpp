#pragma once

#include "app/run/goal_outcome.hpp"

namespace kinetix::app {

/// Returns a compressed zip archive of these files. The same files always give the same bytes.
/// @throws std::runtime_error if the library fails
std::string zip_text(const std::vector<NamedContent>& files);

/// Returns a file of an archive; empty without such a file or archive.
std::string text_in_zip(const std::string& archive, const std::string& name);

}  // namespace kinetix::app
