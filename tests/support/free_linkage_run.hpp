#pragma once

#include <functional>

#include "tests/support/free_linkage.hpp"

namespace kinetix::testing {

/// Settings of a free motion. Joints are those of a compression run (PhysicsOptions says more).
struct FreeLinkageOptions {
  double step_s = 1.0 / 1000;     ///< s, in (0, 0.1]
  double seconds = 1;             ///< of the motion, s, in (0, 1000]
  double joint_stiffness = 1e8;   ///< of the joints, over a mass of 1, in (0, 1e12]
  double error_reduction = 0.95;  ///< part of a hinge's gap removed per step, in (0, 1]
  double reach = 0.18;            ///< half distance of a hinge's two points, units of length, in (0, 10]
  double speed_limit = 1e4;       ///< failure: a faster body, length/s or rad/s, > 0

  /// @throws InvalidInput, naming the field, its value and its range (NaN is outside every range)
  void validate() const;
};

/// Outcome of a free motion.
struct FreeLinkageResult {
  enum class Status { done, blew_up };

  Status status = Status::done;
  std::vector<model::Pose> poses;    ///< last, by body
  std::vector<model::Twist> motion;  ///< last; v of the centres of mass
  FreeLinkageGap gap;                ///< largest at any time
  double energy_start = 0;           ///< as linkage_energy(), kg length^2 / s^2
  double energy_drift = 0;           ///< largest difference from the start at any time, kg length^2 / s^2
  double energy_end = 0;             ///< kg length^2 / s^2
  int steps = 0;
  double seconds = 0;  ///< wall-clock time, s
};

using FreeLinkageObserver = std::function<void(double simulated_s, const std::vector<model::Pose>& poses,
                                               const std::vector<model::Twist>& motion)>;

/// Runs the free motion of a linkage from its start, in the engine and with the joints that verify designs. It tests
/// these on mechanisms with known answers. There is no contact, no friction and no damping; the engine adds the
/// gyroscopic moments. Not thread-safe, as run_compression.
/// @throws InvalidInput for a linkage or options that do not validate; whatever the observer throws
FreeLinkageResult run_linkage(const FreeLinkage& linkage, const FreeLinkageOptions& options,
                              const FreeLinkageObserver& observer = {});

}  // namespace kinetix::testing
