#pragma once

#include <string>
#include <vector>

namespace kinetix::bench {

/// Runs a program and returns its output, line by line.
/// @throws std::runtime_error if it does not start or ends with an error
std::vector<std::string> lines_printed_by(const std::string& command);

}  // namespace kinetix::bench
