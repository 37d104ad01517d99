#include "app/pipeline/drive_loads.hpp"

#include <fmt/format.h>

#include "app/pipeline/physics.hpp"
#include "model/closure/drive_theta.hpp"

namespace kinetix::app {

HingeLoads hinge_loads(const model::EquilibriumPath& path, const model::LinkageDrive& drive,
                       const model::Linkage& linkage, const HingeSection& hinge,
                       const std::map<int, HingeSection>& own) {
  HingeLoads loads;
  loads.reached = path.stop == model::EquilibriumPath::Stop::reached;
  loads.by_lever = drive.is_external() && !drive.has_force();
  if (drive.is_external())
    loads.force_N = largest_load(path) / (drive.has_force() ? 1 : linkage.size.edge_mm);
  for (int h = 0; h < static_cast<int>(linkage.hinges.size()); ++h) {
    const auto& made = hinge_at(hinge, own, h).made;
    if (made) loads.strain = std::max(loads.strain, hinge_strain(*made, linkage, path.state, h));
  }
  return loads;
}

double limit_use(const HingeLimits& limits, const HingeLoads& loads) {
  if (!loads.reached) return INFINITY;
  double share = 0;
  if (limits.force_N) share = std::max(share, loads.force_N / *limits.force_N);
  if (limits.strain) share = std::max(share, loads.strain / *limits.strain);
  return share;
}

LimitRange halve(LimitRange range, const Halvings& halvings,
                 const std::function<std::optional<bool>(double at, double share)>& keeps) {
  for (int k = 0; k < halvings.most && range.exceeded - range.kept > halvings.enough; ++k) {
    const double at = k == 0 && halvings.first ? *halvings.first : (range.kept + range.exceeded) / 2;
    if (at < halvings.least) break;
    const std::optional<bool> kept = keeps(at, static_cast<double>(k) / halvings.most);
    if (!kept) break;
    (*kept ? range.kept : range.exceeded) = at;
  }
  return range;
}

std::vector<std::string> violations(const HingeLimits& limits, const HingeLoads& loads,
                                    const std::string& instead) {
  std::vector<std::string> why;
  if (limits.force_N && !(loads.force_N <= *limits.force_N))
    why.push_back(
        fmt::format("the drive takes {:.3g} N{}; at most {:g} N is allowed, and {} does not keep that",
                    loads.force_N, describe_lever(loads), *limits.force_N, instead));
  if (limits.strain && !(loads.strain <= *limits.strain))
    why.push_back(
        fmt::format("a hinge is strained by {:.2f}; at most {:g} is allowed, and {} does not keep that: a "
                    "longer gap or a thinner hinge strains less",
                    loads.strain, *limits.strain, instead));
  return why;
}

model::LinkageDrive drive_of(const Design& design) {
  if (!design.drive) return drive_to(design.structure, design.theta);
  return drive_on(design.structure, *design.drive, design.theta);
}

double exact_theta_of(const Design& design, const model::ExactMotion& exact) {
  if (!design.drive) return design.theta;
  const model::LinkageDrive drive = drive_of(design);
  if (drive.is_external()) return exact.theta_of(drive);
  return exact_theta({design.structure, drive, exact}, elasticity_of(design));
}

namespace {

/// Returns the target theta, rad: the drive's if there is a drive, otherwise the design's.
double theta_of(const Design& design, const model::ExactMotion& exact) {
  double theta = design.theta;
  if (design.drive) theta = exact ? exact_theta_of(design, exact) : drive_of(design).theta();
  if (theta != 0) return theta;
  throw InvalidInput("the design folds nowhere; give design.theta_deg, a drive or --theta-deg",
                     {"", 0, 0, "design.theta_deg"});
}

constexpr double snap_loss = 0.05;  // ratio to the mean work of a step: error by curved loads and rounding

/// Returns the work of a step, N mm: the energy that it stores. If that is less than the work of the lower load, a
/// snap dissipated the rest, and the work is that of the mean load.
double work_of(const model::EquilibriumStep& a, const model::EquilibriumStep& b, double travel) {
  const double distance = (b.drive - a.drive) * travel, stored = b.energy - a.energy,
               mean = distance * (a.load + b.load) / 2;
  const double least = std::min(distance * a.load, distance * b.load);
  return stored < least - snap_loss * std::abs(mean) ? mean : stored;
}

double work_along(const model::EquilibriumPath& path, double travel) {
  double sum = 0;
  for (std::size_t k = 1; k < path.steps.size(); ++k)
    sum += work_of(path.steps[k - 1], path.steps[k], travel);
  return sum;
}

constexpr double same_theta = 5e-3;  // ratio to theta: work grows with its square, and is known to 1 %
constexpr int max_rounds = 8;    // rounds per drive; each reduces the error by the square of the sheet's lag
constexpr double widest = 1.55;  // rad: limit of a drive, just below a right angle

/// Follows a drive. Repeats with its target scaled by theta over the reached theta, until the sheet reaches theta.
void drive_to(double theta, const model::Linkage& linkage, const model::ExactMotion& exact,
              const model::Elasticity& elasticity, const model::EquilibriumPathOptions& path,
              DriveTrial& trial) {
  for (int k = 0; k < max_rounds; ++k) {
    trial.path = trace_equilibrium({linkage, trial.drive, exact}, elasticity, path);
    trial.theta = mean_theta(linkage, trial.path.state);
    trial.at_goal = std::abs(trial.theta - theta) <= same_theta * std::abs(theta);
    const double next = trial.drive.theta() * theta / trial.theta;
    if (trial.at_goal || !trial.reached() || !(trial.theta * theta > 0) || !(std::abs(next) < widest)) return;
    trial.drive = trial.drive.to(next);
  }
}

void follow(double theta, const model::Linkage& linkage, const model::ExactMotion& exact,
            const model::Elasticity& elasticity, const model::EquilibriumPathOptions& path,
            DriveTrial& trial) {
  drive_to(theta, linkage, exact, elasticity, path, trial);
  trial.load_peak = largest_load(trial.path);
  trial.force_N = trial.drive.has_force() ? trial.load_peak : trial.load_peak / linkage.size.edge_mm;
  trial.work_Nmm = work_along(trial.path, trial.drive.travel(linkage));
  for (const model::PathEvent& event : trial.path.events)
    trial.snaps += event.kind == model::PathEvent::Kind::snap;
}

int least(const std::vector<DriveTrial>& trials, double DriveTrial::*number) {
  int best = -1;
  for (int k = 0; k < static_cast<int>(trials.size()); ++k)
    if (trials[k].holds() && (best < 0 || trials[k].*number < trials[best].*number)) best = k;
  return best;
}

/// Returns the names of the drives not tried: those from index `first` on that exist.
std::vector<std::string> names_after(std::size_t first, const std::vector<model::TrialDrive>& drives) {
  std::vector<std::string> names;
  for (std::size_t k = first; k < drives.size(); ++k)
    if (drives[k].drive) names.push_back(drives[k].name);
  return names;
}

}  // namespace

DriveTrials try_drives(const Design& design, const RunOptions& options) {
  const model::Linkage linkage = design.structure;
  const model::ExactMotion exact = exact_motion(design.structure);
  const model::Elasticity elasticity = elasticity_of(design);
  model::EquilibriumPathOptions path;
  path.stop = options.stop;
  DriveTrials out{design.name, theta_of(design, exact), linkage.size.edge_mm, {}, -1, -1, false, {}};
  const std::vector<model::TrialDrive> drives = trial_drives(design.structure, exact, out.theta);
  for (const model::TrialDrive& drive : drives) {
    options.progress("drives", static_cast<double>(out.trials.size()) / static_cast<double>(drives.size()));
    DriveTrial& trial = out.trials.emplace_back();
    trial.name = drive.name;
    trial.why_not = drive.why_not;
    if (!drive.drive) continue;
    trial.drive = *drive.drive;
    follow(out.theta, linkage, exact, elasticity, path, trial);
    if (!options.stop.stop_requested()) continue;
    out.trials.pop_back();  // incomplete
    out.stopped = true;
    out.not_tried = names_after(out.trials.size(), drives);
    break;
  }
  out.least_force = least(out.trials, &DriveTrial::force_N);
  out.least_work = least(out.trials, &DriveTrial::work_Nmm);
  return out;
}

}  // namespace kinetix::app
