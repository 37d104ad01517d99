#pragma once

#include <functional>

#include "app/run.hpp"
#include "app/target_file.hpp"

namespace kinetix {

/// Words about what is going on, and the share done of the current stage, 0 to 1 (negative: not known).
using Progress = std::function<void(const std::string& stage, double done)>;

/// What the command line adds to a file.
struct RunOptions {
  int threads = 0;  ///< 0 = all cores
  std::uint64_t seed = 0;
  bool verify = true;  ///< run the physics engine
  Progress progress;
};

/// Plan, search, verify. @throws InvalidInput for a target that leaves nothing to search
Run run_curve(const TargetFile& file, const RunOptions& options);

}  // namespace kinetix
