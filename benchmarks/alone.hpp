#pragma once

#include <functional>
#include <optional>

namespace kinetix::bench {

inline constexpr double gib = 1 << 30;  ///< bytes, as memory is counted in

/// What a run took, and whether it ended as it should.
struct Cost {
  double seconds = 0;
  bool right = true;
};

/// The same with the memory that it needed.
struct CostAlone {
  Cost cost;
  double bytes = 0;  ///< most that were in use at once, beyond those before the run
};

/// Runs it in a process of its own.
/// @param allowed_s > 0, whole seconds after which it is given up
/// @return nothing where that ended without an answer: in need of more time or of more memory than there is
/// @throws std::runtime_error where no process can be started   @pre no other thread runs
std::optional<CostAlone> cost_alone(const std::function<Cost()>& run, int allowed_s);

}  // namespace kinetix::bench
