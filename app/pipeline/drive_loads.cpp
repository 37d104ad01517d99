#include "app/pipeline/drive_loads.hpp"

#include <fmt/format.h>

#include "app/pipeline/equilibrium.hpp"
#include "app/pipeline/physics.hpp"
#include "app/run/design_hinges.hpp"
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
        fmt::format("the drive needs {:.3g} N{}; at most {:g} N is allowed, and {} does not change that",
                    loads.force_N, describe_lever(loads), *limits.force_N, instead));
  if (limits.strain && !(loads.strain <= *limits.strain))
    why.push_back(fmt::format(
        "a hinge is strained by {:.2f}; at most {:g} is allowed, and {} does not change that. Use "
        "a longer gap or a thinner hinge",
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
  throw InvalidInput(
      "the fold angle of the design is 0. Give design.fold_angle_deg, a drive or --fold-angle-deg",
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

using SeeStep = std::function<void(const model::EquilibriumStep&, const model::State&)>;

/// Follows a drive. Repeats with its target scaled by theta over the reached theta, until the sheet reaches theta.
void drive_to(double theta, const model::Linkage& linkage, const model::ExactMotion& exact,
              const model::Elasticity& elasticity, const model::EquilibriumPathOptions& path,
              DriveTrial& trial, const SeeStep& see) {
  for (int k = 0; k < max_rounds; ++k) {
    trial.path = trace_equilibrium({linkage, trial.drive, exact}, elasticity, path, see);
    trial.theta = mean_theta(linkage, trial.path.state);
    trial.at_goal = std::abs(trial.theta - theta) <= same_theta * std::abs(theta);
    const double next = trial.drive.theta() * theta / trial.theta;
    if (trial.at_goal || !trial.reached() || !(trial.theta * theta > 0) || !(std::abs(next) < widest)) return;
    trial.drive = trial.drive.to(next);
  }
}

void follow(double theta, const model::Linkage& linkage, const model::ExactMotion& exact,
            const model::Elasticity& elasticity, const model::EquilibriumPathOptions& path, DriveTrial& trial,
            const SeeStep& see = {}) {
  drive_to(theta, linkage, exact, elasticity, path, trial, see);
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

/// Returns a drive as a design has it.
model::Drive as_in_design(const model::LinkageDrive& drive) {
  if (drive.has_plates())
    return model::Plates{.axis = drive.axis, .compression = drive.compression, .branch = drive.branch};
  if (drive.hinge >= 0) return model::HingeTurn{drive.hinge, drive.angle};
  return model::CordPull{drive.through, drive.shorten_mm, drive.branch};
}

constexpr double part = 1e-4;  // rad of theta to either side, the step of difference quotients

/// Sheet with manufactured hinges that is folded along its exact motion.
struct SheetToFold {
  const Design& design;
  const model::ExactMotion& exact;
  double theta;  ///< rad, of the fold
  model::Linkage linkage = design.structure;
  std::vector<model::Elasticity> hinges = {};  ///< stiffness of each

  /// Soft hinges lag behind their drive: it ends beyond the theta of the design, which is the fold.
  SheetToFold(const Design& from, const model::ExactMotion& motion)
      : design(from),
        exact(motion),
        theta(from.theta != 0 && !has_pins_alone(from) ? from.theta : theta_of(from, motion)) {
    for (int h = 0; h < design.structure.hinges(); ++h)
      hinges.push_back(elasticity_of(*hinge_section(design, h).made));
  }
};

/// Computes the energy of all turns from flat in the exact state at theta, N mm.
double turning_energy(const SheetToFold& sheet, double theta) {
  const model::State state = sheet.exact.at(theta);
  double sum = 0;
  for (std::size_t h = 0; h < sheet.hinges.size(); ++h) {
    const double turn = hinge_turn(sheet.linkage, state, static_cast<int>(h));
    sum += sheet.hinges[h].k_turn * turn * turn / 2;
  }
  return sum;
}

/// Computes the load that holds the state at theta against turns of hinges alone, N or N mm: the derivative of the
/// energy by the travel of the drive. Plates approach as the sheet does, which need not follow the cosine of theta.
double holding_load(const SheetToFold& sheet, const model::LinkageDrive& drive, double theta) {
  const auto coordinate = [&](double at) {
    return work_coordinate(drive, sheet.linkage, sheet.exact.at(at));
  };
  const double more = theta + part, less = theta - part;
  return (turning_energy(sheet, more) - turning_energy(sheet, less)) / (coordinate(more) - coordinate(less));
}

constexpr int load_states = 8;  // states from flat to the fold: friction hardly changes between two of them

/// Computes the largest such load from flat to the fold, N or N mm. Plates often need most of it near flat.
double largest_holding_load(const SheetToFold& sheet, const model::LinkageDrive& drive) {
  double most = 0;
  for (int k = 1; k <= load_states; ++k) {
    const double load = std::abs(holding_load(sheet, drive, k * sheet.theta / load_states));
    if (std::isfinite(load)) most = std::max(most, load);
  }
  return most;
}

/// Drive, and the force by which turns of hinges alone resist it at the fold.
struct EstimatedDrive {
  std::string name;
  model::LinkageDrive drive;
  double force_N = 0;  ///< a moment over its lever, one cell edge
};

EstimatedDrive estimated(const SheetToFold& sheet, const std::string& name,
                         const model::LinkageDrive& drive) {
  const double load = std::abs(holding_load(sheet, drive, sheet.theta));
  return {name, drive, drive.has_force() ? load : load / sheet.linkage.size.edge_mm};
}

/// Returns the drive of the design if it has one, else those that exist, those of least force first. Pins resist all
/// of them so little that the usual one comes first.
std::vector<EstimatedDrive> estimated_drives(const SheetToFold& sheet) {
  const Design& design = sheet.design;
  if (design.drive) return {estimated(sheet, describe(*design.drive), drive_of(design))};
  std::vector<EstimatedDrive> all;
  for (const model::TrialDrive& trial : trial_drives(design.structure, sheet.exact, sheet.theta))
    if (trial.drive) all.push_back(estimated(sheet, trial.name, *trial.drive));
  std::erase_if(all, [](const EstimatedDrive& drive) { return !std::isfinite(drive.force_N); });
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.force_N < b.force_N; });
  if (has_pins_alone(design))
    std::stable_partition(all.begin(), all.end(),
                          [&](const EstimatedDrive& drive) { return is_usual_drive(drive.drive, design); });
  return all;
}

Folding folding_by(const std::string& name, const model::LinkageDrive& drive, double load) {
  return {.name = name, .drive = as_in_design(drive), .load = load, .is_force = drive.has_force()};
}

constexpr int max_bodies_to_fold = 180;    // above this, paths of soft hinges take longer than the search
constexpr int max_bodies_to_start = 100;   // above this, the first steps of stiff pins do
constexpr int most_iterations = 15;        // per step: a fold near its exact motion needs about 5
constexpr double shortest_step = 0.01;     // rad of theta: a sheet that needs shorter ones is about to buckle
constexpr double largest_departure = 0.2;  // rad of a hinge from the exact motion: more is another fold

/// Returns the largest difference between a hinge's turn and the exact motion at the same mean turn, rad.
double departure(const SheetToFold& sheet, const model::State& state) {
  return turn_distance(sheet.design.structure, state, sheet.exact.at(mean_theta(sheet.linkage, state)));
}

/// Follows a drive with soft hinges until the sheet leaves its exact motion.
DriveTrial followed(const SheetToFold& sheet, const EstimatedDrive& drive, const std::stop_token& stop) {
  DriveTrial trial{.name = drive.name, .why_not = {}, .drive = drive.drive, .path = {}};
  std::stop_source ends;
  model::EquilibriumPathOptions path = path_of_run(all_vertical(sheet.linkage));
  path.contact = false;  // walls are proven free of contact along the exact motion
  path.min_step = shortest_step;
  path.newton.max_iterations = most_iterations;
  path.stop = ends.get_token();
  const auto see = [&](const model::EquilibriumStep& step, const model::State& state) {
    const double off = departure(sheet, state);
    if (stop.stop_requested() || !(off <= largest_departure)) ends.request_stop();
    if (!(off <= largest_departure) && trial.why_not.empty())
      trial.why_not = fmt::format("the sheet leans or buckles from a fold angle of {:.1f} deg on",
                                  to_degrees(step.theta));
  };
  follow(sheet.theta, sheet.linkage, sheet.exact, elasticity_of(sheet.design), path, trial, see);
  return trial;
}

constexpr double start_of_fold = 0.06;     // rad of theta: other motions begin at flat, and are apart by then
constexpr double start_departure = 0.005;  // rad of a hinge from the exact motion: friction alone leaves less
constexpr double lost_departure = 0.05;    // rad of a hinge: the sheet is on another motion
constexpr double start_min_step = 5e-3;    // rad of theta: paths that need shorter steps are about to branch

/// Checks whether a drive takes a sheet of pins from flat along its exact motion. Pins turn freely, so that motion is the
/// only one near a state that has left flat.
bool starts_along_motion(const SheetToFold& sheet, const EstimatedDrive& drive, const std::stop_token& stop) {
  std::stop_source ends;
  model::EquilibriumPathOptions path = path_of_run(all_vertical(sheet.linkage));
  path.contact = false;
  path.min_step = start_min_step;
  path.newton.max_iterations = most_iterations;
  path.stop = ends.get_token();
  const auto see = [&](const model::EquilibriumStep&, const model::State& state) {
    if (stop.stop_requested() || !(departure(sheet, state) <= lost_departure)) ends.request_stop();
  };
  const double part = std::min(1.0, start_of_fold / std::abs(sheet.theta));
  const model::LinkageDrive start = drive.drive.to(part * drive.drive.theta());
  const model::EquilibriumPath traced =
      trace_equilibrium({sheet.linkage, start, sheet.exact}, elasticity_of(sheet.design), path, see);
  return traced.stop == model::EquilibriumPath::Stop::reached && traced.theta * sheet.theta > 0 &&
         departure(sheet, traced.state) <= start_departure;
}

/// Finds the drive that folds a sheet of pins. If each takes it to another fold, its hinges are turned one by one. Large
/// sheets have the first drive, which is not followed.
std::optional<Folding> free_folding(const SheetToFold& sheet, const std::stop_token& stop) {
  const bool is_large = sheet.design.structure.bodies() > max_bodies_to_start;
  for (const EstimatedDrive& drive : estimated_drives(sheet)) {
    const bool is_along = is_large || starts_along_motion(sheet, drive, stop);
    if (stop.stop_requested()) return std::nullopt;
    if (!is_along) continue;
    Folding found = folding_by(drive.name, drive.drive, largest_holding_load(sheet, drive.drive));
    found.turns_freely = true;
    return found;
  }
  return Folding{.name = "one hinge after the other", .turns_freely = true};
}

/// Returns the names of the drives not tried: those from index `first` on that exist.
std::vector<std::string> names_after(std::size_t first, const std::vector<model::TrialDrive>& drives) {
  std::vector<std::string> names;
  for (std::size_t k = first; k < drives.size(); ++k)
    if (drives[k].drive) names.push_back(drives[k].name);
  return names;
}

}  // namespace

std::optional<Folding> find_folding(const Design& design, const model::ExactMotion& exact,
                                    const std::stop_token& stop) try {
  if (leaves_hinges_open(design) || !exact || (design.theta == 0 && !design.drive)) return std::nullopt;
  const bool has_springs = !drive_of(design).is_external();
  if (has_springs && !has_pins_alone(design)) return std::nullopt;
  if (has_springs) return folding_of({}, drive_of(design), design);
  const SheetToFold sheet(design, exact);
  if (has_pins_alone(design)) return free_folding(sheet, stop);
  if (design.structure.bodies() > max_bodies_to_fold) return std::nullopt;
  std::string why;
  for (const EstimatedDrive& drive : estimated_drives(sheet)) {
    const DriveTrial trial = followed(sheet, drive, stop);
    if (stop.stop_requested()) return std::nullopt;
    if (trial.holds()) return folding_by(trial.name, trial.drive, trial.load_peak);
    if (why.empty())
      why = trial.name + ": " +
            (!trial.why_not.empty() ? trial.why_not
             : trial.reached()      ? "the fold is not stable"
                                    : trial.path.why);
  }
  return Folding{.name = {}, .why_not = "no drive folds it with these hinges (" + why + ")"};
} catch (const InvalidInput& e) {
  return Folding{.name = {}, .why_not = e.reason()};
}

namespace {

/// Returns how the drive of a design folds its elastic hinges. The design is the equilibrium at the end of that drive,
/// which may be far from the exact motion.
Folding equilibrium_folding(const Design& design, const model::ExactMotion& exact) try {
  const model::LinkageDrive drive = drive_of(design);
  model::EquilibriumPathOptions options = path_of_run(all_vertical(model::Linkage(design.structure)));
  options.side = design.side;
  const model::EquilibriumPath path =
      trace_equilibrium({design.structure, drive, exact}, elasticity_of(design), options);
  if (path.stop != model::EquilibriumPath::Stop::reached)
    return {.name = {}, .why_not = drive_stop_reason(path)};
  Folding found = folding_of(path, drive, design);
  found.overstrain = describe_overstrain(design, path.state).value_or("");
  return found;
} catch (const InvalidInput& e) {
  return {.name = {}, .why_not = e.reason()};
}

}  // namespace

std::optional<Folding> find_folding(const Design& design) {
  if (design.structure.assembly() || leaves_hinges_open(design)) return std::nullopt;
  const model::ExactMotion exact = exact_motion(design.structure);
  if (design.drive && design.hinge.model == HingeSection::Model::elastic)
    return equilibrium_folding(design, exact);
  return find_folding(design, exact, {});
}

Folding folding_of(const model::EquilibriumPath& path, const model::LinkageDrive& drive,
                   const Design& design) {
  if (!drive.is_external()) return {.name = "springs of shape memory", .is_unaided = true};
  Folding found = folding_by(describe(as_in_design(drive)), drive, largest_load(path));
  found.turns_freely = has_pins_alone(design);
  return found;
}

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
