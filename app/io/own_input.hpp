#pragma once

#include <string>

namespace kinetix::app {

/// Results must not take the place of what they were made from: a file written by hand loses its comments and patterns, and a
/// result its goal.
/// @param folder for design.yaml and result.json, which need not exist
/// @throws InvalidInput where one of these two is the input
void refuse_own_input(const std::string& input, const std::string& folder);

}  // namespace kinetix::app
