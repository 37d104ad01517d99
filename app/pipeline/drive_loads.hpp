#pragma once

#include "app/files/design_file.hpp"
#include "app/files/hinge_section.hpp"
#include "app/run/run_options.hpp"
#include "app/run/search_result.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::app {

/// Load on the drive and strain of the hinges along an equilibrium path.
struct HingeLoads {
  bool reached = false;   ///< whether the path reached its goal
  double force_N = 0;     ///< largest on the path; of a driven hinge: moment over a cell edge; 0 of springs
  bool by_lever = false;  ///< whether force_N is that of a driven hinge
  double strain = 0;      ///< largest of a block or film hinge at the goal, ratio
};

/// Returns the words that qualify force_N; empty if it is a true force, as of plates.
inline std::string describe_lever(const HingeLoads& loads) {
  return loads.by_lever ? " at the lever of a cell edge" : "";
}

/// Computes the load on the drive and the strain of the hinges along a path. @param own sections of hinges that
/// differ from the rest
HingeLoads hinge_loads(const model::EquilibriumPath& path, const model::LinkageDrive& drive,
                       const model::Linkage& linkage, const HingeSection& hinge,
                       const std::map<int, HingeSection>& own = {});

/// Returns the largest ratio of a load to its limit; infinite without an equilibrium.
double limit_use(const HingeLimits& limits, const HingeLoads& loads);

/// Range in which limits are kept at one end and not at the other.
struct LimitRange {
  double kept = 0;      ///< end at which limits are kept, ratio or unit of the value
  double exceeded = 1;  ///< end at which limits are exceeded, ratio or unit of the value
};

/// Settings of a bisection for the largest load that keeps limits. Values are in the unit of the range.
struct Halvings {
  int most = 0;
  double enough = 0;                 ///< width at which the search stops, unit of the range
  std::optional<double> first = {};  ///< first value tried, unit of the range; empty: the middle
  double least = 0;                  ///< values below are not tried, unit of the range
};

/// Halves the range until it is narrow enough. @param keeps whether limits are kept at a value; empty: stop. Its
/// `share` is the part of the search that is done
LimitRange halve(LimitRange range, const Halvings& halvings,
                 const std::function<std::optional<bool>(double at, double share)>& keeps);

/// Describes the limits that are exceeded, one sentence each. @param instead what a search could reduce, "less
/// compression"; the sentence says that this does not keep the limit
std::vector<std::string> violations(const HingeLimits& limits, const HingeLoads& loads,
                                    const std::string& instead);

/// Returns the drive of a design: the file's, otherwise one to its theta. Bodies that are pulled have none.
model::LinkageDrive drive_of(const Design& design);

/// Returns the theta to which drive_of() takes a design along its closed form, rad. Without a drive it is the
/// design's theta to the last bit. With springs it follows from their stiffness and that of the hinges.
/// @pre exact
double exact_theta_of(const Design& design, const model::ExactMotion& exact);

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

/// Finds how a sheet with its manufactured hinges is folded from flat to its theta. Pins turn freely: their drive is the
/// design's, else the usual one of the sheet, and the load the largest of their friction along the exact motion. With soft
/// hinges it is the drive of the design, else the drive of least force, of model::trial_drives, that holds the sheet
/// there. Drives are followed in equilibrium, those first whose force is least if only turns of hinges resist.
/// Empty without an exact motion or a theta, for hinges that are left open, for soft hinges with springs or in more than
/// 180 bodies, and after a stop request. A drive of the design that does not reach its end is reported as one.
/// @param exact motion of the sheet
std::optional<Folding> find_folding(const Design& design, const model::ExactMotion& exact,
                                    const std::stop_token& stop);
/// Finds it for a design whose motion is not known yet. Elastic hinges with a drive have the folding of their equilibrium.
std::optional<Folding> find_folding(const Design& design);
/// Returns the folding of a design along an equilibrium path that reached its goal.
Folding folding_of(const model::EquilibriumPath& path, const model::LinkageDrive& drive,
                   const Design& design);

/// Tries the drives of model::trial_drives on a design with elastic hinges. Each folds the sheet from flat until its
/// mean theta is the design's. After a stop request, returns the trials so far.
/// @throws InvalidInput for a design without a theta to fold to
DriveTrials try_drives(const Design& design, const RunOptions& options);

}  // namespace kinetix::app
