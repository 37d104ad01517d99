#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kinetix::app {

// Regular expressions (ECMAScript's), in one place because the standard library's take a compiler seconds.

/// The first match in a text, then what its groups hold, empty for a group that is not in it; none without a match.
std::vector<std::string> first_match(std::string_view text, const std::string& pattern);

/// All matches, in order.
std::vector<std::string> all_matches(std::string_view text, const std::string& pattern);

/// The text with every match replaced; $1 stands for what the first group holds.
std::string with_matches_replaced(std::string_view text, const std::string& pattern, const std::string& by);

}  // namespace kinetix::app
