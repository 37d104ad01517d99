#pragma once

#include <string>

namespace kinetix::app {

/// Where results go, which must not take the place of what they were made from: a file written by hand loses its comments and
/// patterns, and a result its goal.
/// @param folder for design.yaml and result.json, which need not exist   @param is_given by the user, who is not overruled
/// @return the folder, or where that is the input's own, NAME_2 beside it
/// @throws InvalidInput where it was given and one of these two files in it is the input
std::string folder_beside_input(const std::string& input, const std::string& folder, bool is_given);

}  // namespace kinetix::app
