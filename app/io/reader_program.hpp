#pragma once

#include <string>
#include <vector>

namespace kinetix::app {

// A library that reads a foreign format may crash, hang or fill all memory on a damaged file. If its checks are not
// known to be complete, a separate program uses it, which is installed next to the modules. That program is started
// anew, not forked. It shares no locks and no memory with the threads of this one. A studio or a Python session may
// therefore call it at any time.

/// Exit code of a reader program.
enum class ReaderEnd {
  done = 0,          ///< its standard output holds what it read
  refused = 2,       ///< its standard output holds the reason
  out_of_memory = 3  ///< it reached its limit of memory
};

/// Limits of CPU time and memory for a reader program.
struct ReaderLimits {
  unsigned long cpu_s = 0;
  unsigned long memory_bytes = 0;
};

/// Runs a reader program. @return its output.
/// @throws InvalidInput without a place: the program refused the file, crashed, or used more than its limits.
/// @throws std::runtime_error if the program is missing or cannot be started
std::string run_reader(const std::string& program, const std::vector<std::string>& arguments,
                       const ReaderLimits& limits);

}  // namespace kinetix::app
