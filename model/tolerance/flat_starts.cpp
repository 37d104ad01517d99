#include "model/tolerance/flat_starts.hpp"

#include <cmath>
#include <vector>

#include "model/base/invalid_input.hpp"
#include "model/base/parallel_runs.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/tolerance/print_errors.hpp"

namespace kinetix::model {
namespace {

/// Returns the theta at which the path of a print ends, rad; NaN if it does not reach the end of the drive.
double pressed_theta(const Linkage& print, const Elasticity& elasticity, const LinkageDrive& drive,
                     const EquilibriumPathOptions& options) {
  const EquilibriumPath path = trace_equilibrium({print, drive, {}}, elasticity, options);
  return path.stop == EquilibriumPath::Stop::reached ? mean_theta(print, path.state) : std::nan("");
}

/// Final theta of a print that is driven to either side, times the sign of the requested side, rad.
struct Ends {
  double there = NAN, back = NAN;
};

}  // namespace

std::optional<FlatStarts> flat_starts(const PrintedLinkage& printed, const Elasticity& elasticity,
                                      const LinkageDrive& drive, const HingeScatter& scatter, int count,
                                      const ToleranceOptions& options, EquilibriumPathOptions path) {
  const auto stops = [&] { return options.stop && options.stop(); };
  path.planar = options.planar;
  const double theta = drive.theta();
  PrintErrors errors(scatter, static_cast<Eigen::Index>(printed({}).hinges.size()), options.seed);
  std::vector<Eigen::Matrix4Xd> all(static_cast<std::size_t>(count));
  for (Eigen::Matrix4Xd& of_print : all) of_print = errors.next();
  std::vector<Ends> ends(all.size());
  run_in_parallel(count, options.threads, [&](int k) {
    if (stops()) return;
    try {
      const Linkage print = printed(all[k]);
      const double sign = std::copysign(1.0, theta);
      ends[k].there = sign * pressed_theta(print, elasticity, drive, path);
      ends[k].back = sign * pressed_theta(print, elasticity, drive.to(-theta), path);
    } catch (const InvalidInput&) {  // walls that overlap as printed
    }
  });
  if (stops()) return std::nullopt;
  FlatStarts out;
  for (const Ends& end : ends) {
    const bool has_ends = std::isfinite(end.there) && std::isfinite(end.back);
    out.prints += has_ends;
    out.failed += !has_ends;
    out.other_side += has_ends && end.there < 0 && end.back < 0;
    out.either_side += has_ends && (end.there < 0) != (end.back < 0);
  }
  return out;
}

}  // namespace kinetix::model
