#pragma once

#include <functional>

#include "model/tolerance/print_equilibria.hpp"
#include "model/tolerance/settled_design.hpp"

namespace kinetix::model {

/// What a number of prints came to, each brought to its equilibrium anew: what as_made() says to first order.
struct PrintRuns {
  int prints = 0;     ///< those that settled near the design
  int failed = 0;     ///< all others, those among them whose walls overlap as built
  double rms_mm = 0;  ///< root of the mean square over those that settled; NaN where none did
  double p95_mm = 0;  ///< 95 of 100 of them keep it: kept() of these do
  double first_order_rms_mm =
      0;                   ///< of the same prints, as first order has each of them; NaN where it has none
  double ratio_error = 0;  ///< ratio: standard error of rms_mm over first_order_rms_mm

  /// Of 20 prints 19, and not what 95 of 100 others would be: the fewest that are that part of them or more.
  int kept() const { return (19 * prints + 19) / 20; }
};

/// Prints with errors, each brought to its equilibrium from that of the design, and seen one after the other.
/// @param state of the design, in equilibrium or nearly so under the drive
/// @param options seed, planar, contact, threads and stop have an effect; `printed` is called from any of the threads
/// @param visit sees the design's own equilibrium, that of each print that settled, and its errors
/// @return how many did not, of those that it was not told to leave out. The same seed gives the same prints.
int visit_prints(const PrintedLinkage& printed, const Elasticity& elasticity, const LinkageDrive& drive,
                 const State& state, const HingeScatter& scatter, int count, const AsMadeOptions& options,
                 const std::function<void(const State& design, const State& print,
                                          const Eigen::Matrix4Xd& errors)>& visit);

/// @param count > 0   @param options its probes have no effect   The same seed gives the same prints.
PrintRuns print_runs(const PrintedLinkage& printed, const SettledDesign& design,
                     const std::vector<ObservedPoint>& points, const HingeScatter& scatter, int count,
                     const AsMadeOptions& options = {});

}  // namespace kinetix::model
