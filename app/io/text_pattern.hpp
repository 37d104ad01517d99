#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kinetix::app {

// Regular expressions (ECMAScript's), in one place: those of the standard library take a compiler seconds.

/// Returns the first match in a text, then each group's content, empty for a group outside it. Empty without a match.
std::vector<std::string> first_match(std::string_view text, const std::string& pattern);

/// Returns all matches, in order.
std::vector<std::string> all_matches(std::string_view text, const std::string& pattern);

/// Returns the text with every match replaced; $1 stands for the content of the first group.
std::string with_matches_replaced(std::string_view text, const std::string& pattern, const std::string& by);

}  // namespace kinetix::app
