#pragma once

#include <string>
#include <vector>

namespace kinetix::app {

// A library that reads a foreign format may crash, hang or take all memory on a damaged file. Where its checks are not
// known to be complete, it is used by a program of its own, which is installed beside the modules. That program is
// started anew, not forked: it shares no locks and no memory with the threads of this one, so that a studio or a Python
// session may call it at any time.

/// How a reader program ends.
enum class ReaderEnd {
  done = 0,          ///< its standard output holds what it read
  refused = 2,       ///< its standard output holds the reason
  out_of_memory = 3  ///< of its own limit
};

/// What a reader program may use of the processor and of memory.
struct ReaderLimits {
  unsigned long cpu_s = 0;
  unsigned long memory_bytes = 0;
};

/// Runs a reader program. @return what it wrote
/// @throws InvalidInput without a place: the program refused the file, crashed, or used more than its limits
/// @throws std::runtime_error where the program is missing or cannot be started
std::string run_reader(const std::string& program, const std::vector<std::string>& arguments,
                       const ReaderLimits& limits);

}  // namespace kinetix::app
