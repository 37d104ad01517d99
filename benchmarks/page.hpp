#pragma once

#include <string>
#include <utility>
#include <vector>

namespace kinetix::bench {

/// Replaces the text of a page between the marks `<!-- NAME: ... -->` and `<!-- end of NAME -->`.
/// @throws std::runtime_error for a name that the page does not have
void write_into(const std::string& file, const std::vector<std::pair<std::string, std::string>>& texts);

}  // namespace kinetix::bench
