#pragma once

#include <string>
#include <vector>

#include "app/files/design_file.hpp"
#include "app/run/run_options.hpp"
#include "model/elastic/path/equilibrium_path.hpp"

namespace kinetix::app {

/// A drive that was tried, and what it takes to fold the sheet by it.
struct DriveTrial {
  std::string name;
  std::string why_not;  ///< not empty: there is no such drive; nothing below holds then
  model::LinkageDrive drive;
  model::EquilibriumPath path;
  double theta = 0;      ///< mean of the sheet's hinges at the end, rad
  double load_peak = 0;  ///< largest on the way, N or N mm
  double force_N = 0;    ///< the same as a force: a moment by its lever, one cell edge
  double work_Nmm =
      0;  ///< N mm, of the load along the path: what a slow drive puts in, less what it gets back
  int snaps = 0;

  /// Whether that is the theta it was meant to come to: drives are driven on, or less far, until it is.
  bool at_goal = false;

  bool reached() const { return why_not.empty() && path.stop == model::EquilibriumPath::Stop::reached; }
  /// Whether it took the sheet to a stable state at that theta.
  bool holds() const { return reached() && at_goal && path.steps.back().stable; }
};

struct DriveTrials {
  std::string name;
  double theta = 0;     ///< rad, to which each drive is meant to take the sheet
  double lever_mm = 0;  ///< at which moments are compared with forces: one cell edge
  std::vector<DriveTrial> trials;
  int least_force = -1, least_work = -1;  ///< of those that hold; -1: none does
  bool stopped = false;                   ///< before all drives were tried
  std::vector<std::string> not_tried;     ///< names of those that were not, where it was stopped
};

/// Tries the drives of model::trial_drives on a design with elastic hinges, each from flat to where the mean theta of the
/// sheet is the design's.
/// Where it is told to stop, those that were tried so far.
/// @throws InvalidInput for a design that says no theta to fold to
DriveTrials try_drives(const Design& design, const RunOptions& options);

}  // namespace kinetix::app
