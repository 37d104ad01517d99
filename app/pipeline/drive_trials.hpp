#pragma once

#include <string>
#include <vector>

#include "app/files/design_file.hpp"
#include "app/run/run_options.hpp"
#include "model/elastic/path/equilibrium_path.hpp"

namespace kinetix::app {

/// Drive that was tried, with the load and work that fold the sheet by it.
struct DriveTrial {
  std::string name;
  std::string why_not;  ///< not empty: there is no such drive, and the fields below are unset
  model::LinkageDrive drive;
  model::EquilibriumPath path;
  double theta = 0;      ///< mean of the sheet's hinges at the end, rad
  double load_peak = 0;  ///< largest on the path, N or N mm
  double force_N = 0;    ///< load_peak as a force: a moment over its lever, one cell edge
  double work_Nmm = 0;   ///< N mm along the path: what a slow drive puts in, less what it gets back
  int snaps = 0;

  /// Whether `theta` is the goal. The drive is repeated with a larger or smaller target until it is.
  bool at_goal = false;

  bool reached() const { return why_not.empty() && path.stop == model::EquilibriumPath::Stop::reached; }
  /// Whether the drive took the sheet to a stable state at the goal.
  bool holds() const { return reached() && at_goal && path.steps.back().stable; }
};

struct DriveTrials {
  std::string name;
  double theta = 0;     ///< rad, goal of each drive
  double lever_mm = 0;  ///< lever that converts moments to forces: one cell edge
  std::vector<DriveTrial> trials;
  int least_force = -1, least_work = -1;  ///< index of the best trial that holds; -1: none
  bool stopped = false;                   ///< whether a stop request came before all drives were tried
  std::vector<std::string> not_tried;     ///< names of the drives left out after a stop request
};

/// Tries the drives of model::trial_drives on a design with elastic hinges. Each folds the sheet from flat until its
/// mean theta is the design's. After a stop request, returns the trials so far.
/// @throws InvalidInput for a design without a theta to fold to
DriveTrials try_drives(const Design& design, const RunOptions& options);

}  // namespace kinetix::app
