#pragma once

#include <functional>

#include "model/tolerance/print_equilibria.hpp"
#include "model/tolerance/settled_design.hpp"

namespace kinetix::model {

/// Print tolerance from a number of sample prints, each with a new equilibrium; as_made() estimates it to
/// first order.
struct PrintRuns {
  int prints = 0;     ///< that settled near the design
  int failed = 0;     ///< all others, including those whose walls overlap as built
  double rms_mm = 0;  ///< root mean square over those that settled; NaN if none did
  double p95_mm = 0;  ///< largest value of the best kept() prints
  /// Rms of the same prints to first order, mm; NaN if the design is not stable.
  double first_order_rms_mm = 0;
  double ratio_error = 0;  ///< relative: standard error of rms_mm / first_order_rms_mm

  /// Returns the least number of prints that is 95 % of them or more: 19 of 20. It is not an estimate for
  /// other prints.
  int kept() const { return (19 * prints + 19) / 20; }
};

/// Brings prints with errors to equilibrium, starting from that of the design, and visits them one by one.
/// @param state of the design, in equilibrium or nearly so under the drive.
/// @param options only seed, planar, contact, threads and stop have an effect. `printed` is called from any
///   thread
/// @param visit called with the design's equilibrium, that of each print that settled, and its errors.
/// @return how many of the tried prints did not settle. The same seed gives the same prints
int visit_prints(const PrintedLinkage& printed, const Elasticity& elasticity, const LinkageDrive& drive,
                 const State& state, const HingeScatter& scatter, int count, const ToleranceOptions& options,
                 const std::function<void(const State& design, const State& print,
                                          const Eigen::Matrix4Xd& errors)>& visit);

/// Computes the print tolerance from sample prints. The same seed gives the same prints.
/// @param count > 0   @param options its probes have no effect
PrintRuns print_runs(const PrintedLinkage& printed, const SettledDesign& design,
                     const std::vector<ObservedPoint>& points, const HingeScatter& scatter, int count,
                     const ToleranceOptions& options = {});

}  // namespace kinetix::model
