#pragma once

#include "model/elastic/path/equilibrium_path.hpp"
#include "model/tolerance/print_equilibria.hpp"

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

/// Outcome of sample prints that plates press from flat, the state in which they are printed. Plates select
/// no side, and the errors of a print need not select one either.
struct FlatStarts {
  int prints = 0;       ///< that reached the end of their drive
  int other_side = 0;   ///< of these, pushed by their errors to the side that is not requested
  int either_side = 0;  ///< of these, pushed to no side: chance decides
  int failed = 0;       ///< all others

  /// Returns whether some prints do not fold to the requested side without help.
  bool need_guidance() const { return other_side + either_side > 0; }
};

/// Traces the path of each print to both sides. If errors push a print, both paths end on one side, that of
/// the mean turn of its hinges (mean_theta()). Without a push, each path leaves flat by a bifurcation to its
/// side.
/// @param drive plates
/// @param count > 0
/// @param options only seed, planar, threads and stop have an effect.
/// @param path options of the path of each print
/// @return empty if options.stop ends the run before the last print
std::optional<FlatStarts> flat_starts(const PrintedLinkage& printed, const Elasticity& elasticity,
                                      const LinkageDrive& drive, const HingeScatter& scatter, int count,
                                      const ToleranceOptions& options, EquilibriumPathOptions path = {});

}  // namespace kinetix::model
