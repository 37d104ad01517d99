#pragma once

#include "app/run_curve.hpp"

namespace kinetix {

/// Plan, search, verify, for a target of any kind. @throws InvalidInput for a target that leaves nothing to
/// search
Run run_target(const Target& target, const RunOptions& options);

/// What the design that was found lacks, in words; empty where it is as the target asks, and for designs that
/// were not searched for.
std::vector<std::string> misses_of(const Run& run);

}  // namespace kinetix
