#pragma once

#include <functional>
#include <optional>

namespace kinetix::bench {

inline constexpr double gib = 1 << 30;  ///< bytes in a gibibyte

/// Time of a run, and whether it ended correctly.
struct Cost {
  double seconds = 0;
  bool right = true;
};

/// Cost of a run, with the memory that it needed.
struct CostAlone {
  Cost cost;
  double bytes = 0;  ///< most that were in use at once, beyond those before the run
};

/// Runs it in a separate process.
/// @param allowed_s > 0, whole seconds after which the run is given up.
/// @return empty if the process ended without an answer: it needed more time, or more memory than there is.
/// @throws std::runtime_error if no process can be started.   @pre no other thread runs
std::optional<CostAlone> cost_alone(const std::function<Cost()>& run, int allowed_s);

}  // namespace kinetix::bench
