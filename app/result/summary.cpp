#include "app/result/summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "app/pipeline/imported_bodies.hpp"
#include "app/result/motion_evidence.hpp"
#include "app/result/print_evidence.hpp"
#include "app/result/result_json.hpp"
#include "app/result/verdict.hpp"

namespace kinetix::app {
namespace {

std::string line(const std::string& label, const std::string& text) {
  return fmt::format("  {:<10} {}\n", label, text);
}

std::string in_mm(const Run& run, double cell_edges) {
  return format_figures(cell_edges * run.design.structure.size().edge_mm) + " mm";
}

double largest_tilt(const model::Lattice& structure) {
  double largest = 0;
  for (int h = 0; h < structure.hinges(); ++h) largest = std::max(largest, std::abs(structure.hinge(h).beta));
  return largest;
}

std::string physics_lines(const Run& run) {
  const Verification& v = *run.verification;
  if (v.physics.status != sim::PhysicsResult::Status::settled)
    return line("check", failed_simulation_reason(v));
  if (!v.compared)
    return line("check", fmt::format("simulation settled in {:.2g} s; no {} to compare with",
                                     v.physics.seconds, reference_name(run)));
  std::string text =
      line("check", fmt::format("simulation {}: {} rms from the {}, joint separation at most {}, {:.2g} s",
                                v.agrees ? "agrees" : "disagrees", in_mm(run, v.distance.rms),
                                reference_name(run), in_mm(run, v.physics.gaps.max), v.physics.seconds));
  if (v.equilibrium && !v.agrees) text += line("compared", v.equilibrium->why);
  return text;
}

std::string structure_lines(const Run& run) {
  const model::Lattice& structure = run.design.structure;
  if (run.closed_path)
    return line("bodies", fmt::format("{}, {} hinges", structure.bodies(), structure.hinges())) +
           line(run.closed_path->off ? "pull" : "closure", run.closed_path->description);
  return line("sheet", fmt::format("{} bodies, {} hinges", structure.bodies(), structure.hinges())) +
         line("plan", run.plan.exact.why) +
         line("fold", fmt::format("fold angle {:.2f} deg, largest wall tilt {:.2f} deg",
                                  to_degrees(run.theta), to_degrees(largest_tilt(structure))));
}

// Limits of the lists in a summary: enough for a reader in a terminal. result.json has complete lists.
constexpr std::size_t max_events = 12, max_states = 6;

std::string load_text(const Equilibrium& equilibrium, const model::EquilibriumStep& step) {
  return fmt::format("{:.3g} {}", step.load, equilibrium.drive.load_unit());
}

std::string theta_text(const Equilibrium& equilibrium, const model::EquilibriumStep& step) {
  return fmt::format("fold angle {:.2f} deg{}", to_degrees(step.theta),
                     equilibrium.drive.determines_fold() ? "" : " of the drive");
}

std::string peak_load_text(const Equilibrium& equilibrium) {
  const char* gripped = equilibrium.path.let_go > 0 ? ", by plates that grip until the end" : "";
  return fmt::format("{:.3g} {} ({}){}", largest_load(equilibrium.path), equilibrium.drive.load_unit(),
                     describe_effort_class(classify_load(equilibrium)), gripped);
}

std::string drive_text(const Equilibrium& equilibrium, const model::EquilibriumStep& step) {
  const std::string words = equilibrium.drive.describe_coordinate(),
                    unit = equilibrium.drive.coordinate_unit();
  if (unit == "rad") return fmt::format("{} {:.4g} deg", words, to_degrees(step.drive));
  return fmt::format("{} {:.4g}{}", words, step.drive, unit == "mm" ? " mm" : "");
}

std::string describe_locked_bodies(const Lock& lock) {
  return fmt::format("a {} on bodies {} and {} keeps the fold; `lock: none` leaves it out", lock.kind,
                     lock.bodies[0], lock.bodies[1]);
}

/// Returns words before the load of tendons and springs; "" for loads that their unit describes.
std::string describe_load_point(const Equilibrium& equilibrium) {
  if (equilibrium.drive.only_pulls())
    return equilibrium.path.steps.back().load < 0 ? "the tendon is slack, it would have to push: tension "
                                                  : "tension ";
  if (equilibrium.drive.is_external()) return "";
  return fmt::format("{:.4g} N mm from each of {} springs, together ", mean_moment(equilibrium),
                     equilibrium.drive.springs.size());
}

std::string energy_text(const model::EquilibriumPath& path) {
  model::HingeEnergy sum;
  for (const model::HingeEnergy& energy : path.hinge_energies) {
    sum.stretch += energy.stretch;
    sum.turn += energy.turn;
  }
  const double total = path.steps.back().energy;
  const double contact = std::max(0.0, total - sum.total() - path.steps.back().springs);
  const std::string springs = path.steps.back().springs > 0
                                  ? fmt::format(", {:.3g} in the drive's springs", path.steps.back().springs)
                                  : "";
  return fmt::format("{:.3g} N mm ({:.3g} in joint separation, {:.3g} in rotation, {:.2g} in contact{})",
                     total, sum.stretch, sum.turn, contact, springs);
}

std::string press_text(const Equilibrium& equilibrium) {
  const model::GrippedRows& rows = equilibrium.drive.gripped;
  return fmt::format("push-only plates: {} of {} bodies of their rows have lost contact",
                     equilibrium.path.let_go, rows[0].size() + rows[1].size());
}

std::string stretch_text(const Run& run) {
  const model::HingeGaps& gaps = run.equilibrium->path.gaps;
  std::string text = "separated by at most " + in_mm(run, gaps.max);
  if (gaps.worst_hinge >= 0 && gaps.max > 0)
    text += (run.design.structure.assembly() ? ", at hinge " : ", on wall ") +
            wall_name(run.design.structure, gaps.worst_hinge);
  return text;
}

std::string stable_text(const model::StableStates& stable) {
  std::string text = fmt::format("{} states: flat", stable.states.size());
  for (std::size_t k = 1; k < std::min(max_states, stable.states.size()); ++k)
    text += fmt::format(", fold angle {:.2f} deg ({:.3g} N mm)", to_degrees(stable.states[k].theta),
                        stable.states[k].energy);
  if (stable.states.size() > max_states) text += ", and more in result.json";
  for (std::size_t k = 0; k < std::min(max_states, stable.barriers.size()); ++k)
    text += fmt::format("; barrier {:.3g} N mm at fold angle {:.2f} deg", stable.barriers[k].energy,
                        to_degrees(stable.barriers[k].theta));
  return text;
}

using Json = nlohmann::ordered_json;

// Ratio of forces or works: smaller differences are within the differences of final theta and hinge stretch.
constexpr double alike = 0.02;

std::string path_text(const DriveTrial& trial) {
  const std::string snaps = trial.snaps == 0   ? "no snap"
                            : trial.snaps == 1 ? "1 snap"
                                               : fmt::format("{} snaps", trial.snaps);
  if (!trial.reached()) return app::describe(trial.path.stop) + ", " + snaps;
  return snaps + (trial.path.steps.back().stable ? ", stable" : ", unstable") +
         (trial.path.off_closed_form ? ", off the ideal motion" : "") +
         (trial.at_goal ? "" : ", not at that fold angle");
}

std::string trial_line(const DriveTrial& trial, std::size_t width) {
  if (!trial.why_not.empty())
    return fmt::format("  {:<{}}  not tried: {}\n", trial.name, width, trial.why_not);
  const model::EquilibriumStep& last = trial.path.steps.back();
  return fmt::format("  {:<{}}  {:>10} {:<4}  {:>10}  {:>10}  {:>10}  {:>6.1f}  {}\n", trial.name, width,
                     fmt::format("{:.4g}", trial.load_peak), trial.drive.load_unit(),
                     fmt::format("{:.4g}", trial.force_N), fmt::format("{:.4g}", trial.work_Nmm),
                     fmt::format("{:.4g}", last.energy), to_degrees(trial.theta), path_text(trial));
}

/// Lists the other stable drives that need at most 2 % more.
std::string alike_text(const DriveTrials& all, int best, double DriveTrial::*number) {
  std::string names;
  for (int k = 0; k < static_cast<int>(all.trials.size()); ++k)
    if (k != best && all.trials[k].holds() && all.trials[k].*number <= (1 + alike) * all.trials[best].*number)
      names += (names.empty() ? "" : ", ") + all.trials[k].name;
  return names.empty() ? "" : fmt::format("; within {:g} %: {}", 100 * alike, names);
}

/// Describes the drives with the least force and the least work. After a stop, only among those tried.
std::string least_text(const DriveTrials& all) {
  const char* among = all.stopped ? ", of those tried" : "";
  const DriveTrial &force = all.trials[all.least_force], &work = all.trials[all.least_work];
  return fmt::format("  least force{}  {}: {:.4g} N at most{}\n  least work{}   {}: {:.4g} N mm{}\n", among,
                     force.name, force.force_N, alike_text(all, all.least_force, &DriveTrial::force_N), among,
                     work.name, work.work_Nmm, alike_text(all, all.least_work, &DriveTrial::work_Nmm));
}

std::string verdict(const DriveTrials& all) {
  const std::string stopped =
      all.stopped ? fmt::format("  stopped; not tried: {}\n", fmt::join(all.not_tried, ", ")) : "";
  if (all.least_force >= 0) return stopped + least_text(all);
  return all.stopped ? stopped : "  no drive reaches this fold angle\n";
}

Json trial_json(const DriveTrial& trial) {
  if (!trial.why_not.empty()) return {{"name", trial.name}, {"why_not", trial.why_not}};
  const model::EquilibriumStep& last = trial.path.steps.back();
  return {{"name", trial.name},
          {"reached", trial.reached()},
          {"why", trial.path.why},
          {"drive", last.drive},
          {"drive_unit", trial.drive.coordinate_unit()},
          {"load_peak", trial.load_peak},
          {"load_end", last.load},
          {"load_unit", trial.drive.load_unit()},
          {"force_N", trial.force_N},
          {"work_Nmm", trial.work_Nmm},
          {"energy_Nmm", last.energy},
          {"theta_rad", trial.theta},
          {"at_goal", trial.at_goal},
          {"snaps", trial.snaps},
          {"stable", last.stable}};
}

Json name_of(const DriveTrials& all, int trial) {
  return trial < 0 ? Json(nullptr) : Json(all.trials[trial].name);
}

}  // namespace

std::string summary(const Run& run) {
  const RunVerdict verdict = verdict_of(run);
  std::string text = fmt::format("{}: {}\n", run.design.name, headline(verdict));
  for (const auto& [level, words] : problem_lines(verdict)) text += line(level + ":", words);
  const auto add_all = [&text](const std::vector<SummaryLine>& lines) {
    for (const auto& [label, words] : lines) text += line(label, words);
  };
  text += structure_lines(run);
  if (run.certified)
    add_all(certified_lines(*run.certified, run.design.structure, run.theta, closed_form_relation(run)));
  if (const auto worst = worst_strain(run))
    text += line("strain", fmt::format("peak {:.3g} in the hinges, limit of their material {:g}",
                                       worst->strain, worst->allowed));
  if (run.goal) add_all(run.goal->summary_lines(run));
  add_all(compensation_lines(run));
  add_all(robust_lines(run));
  add_all(print_tolerance_lines(run));
  if (run.folding && run.folding->is_possible()) text += line("force", describe_folding(*run.folding));
  if (run.print && run.print->lock) text += line("lock", describe_locked_bodies(*run.print->lock));
  if (run.equilibrium) add_all(equilibrium_lines(run));
  if (run.verification) text += physics_lines(run);
  if (run.pieces)
    text += line("pieces", fmt::format("{} convex pieces of the bodies for contact, made in {:.2g} s",
                                       run.pieces->count(), run.pieces->seconds));
  return text;
}

std::vector<std::array<std::string, 2>> equilibrium_lines(const Run& run) {
  const Equilibrium& equilibrium = *run.equilibrium;
  const model::EquilibriumPath& path = equilibrium.path;
  const model::EquilibriumStep& last = path.steps.back();
  std::vector<std::array<std::string, 2>> lines;
  if (!equilibrium.reached()) lines.push_back({"stopped", describe(path.stop) + ": " + path.why});
  lines.push_back({"load", describe_load_point(equilibrium) + load_text(equilibrium, last) + " at " +
                               drive_text(equilibrium, last) +
                               (equilibrium.reached() ? ", the end of the drive" : "")});
  if (equilibrium.is_on_the_other_side(run.theta))
    lines.push_back({"side", describe_other_side(equilibrium, run.theta)});
  if (equilibrium.drive.is_external()) lines.push_back({"peak", peak_load_text(equilibrium)});
  if (equilibrium.drive.press && equilibrium.reached()) lines.push_back({"plates", press_text(equilibrium)});
  lines.push_back({"energy", energy_text(path)});
  lines.push_back({"joints", stretch_text(run)});
  for (std::size_t k = 0; k < std::min(max_events, path.events.size()); ++k) {
    const model::PathEvent& event = path.events[k];
    lines.push_back(
        {"event",
         fmt::format("{} at {}, {}, load {}: {}", to_string(event.kind), drive_text(equilibrium, event.at),
                     theta_text(equilibrium, event.at), load_text(equilibrium, event.at), event.what)});
  }
  if (path.events.size() > max_events)
    lines.push_back({"", fmt::format("and {} more events in result.json", path.events.size() - max_events)});
  if (equilibrium.stable.states.size() > 1) lines.push_back({"stable", stable_text(equilibrium.stable)});
  for (const std::string& why : equilibrium.stable.unresolved) lines.push_back({"release", why});
  if (equilibrium.from_exact)
    lines.push_back({"ideal", fmt::format("{} rms from the ideal motion of the same drive",
                                          in_mm(run, equilibrium.from_exact->rms))});
  return lines;
}

std::string summary(const DriveTrials& all) {
  std::size_t width = 5;  // characters of the heading "drive"
  for (const DriveTrial& trial : all.trials) width = std::max(width, trial.name.size());
  std::string text = fmt::format(
      "{}: slow drives to fold angle {:.2f} deg; moments count as forces at a lever of one cell edge, {:g} "
      "mm\n",
      all.name, to_degrees(all.theta), all.lever_mm);
  text += fmt::format("  {:<{}}  {:>15}  {:>10}  {:>10}  {:>10}  {:>6}  {}\n", "drive", width, "largest load",
                      "as force N", "work N mm", "energy", "theta", "path and end");
  for (const DriveTrial& trial : all.trials) text += trial_line(trial, width);
  return text + verdict(all);
}

ShortForm short_form(const DriveTrials& all) {
  ShortForm out{.title = fmt::format("{}: {} drives to fold angle {:.3g} deg compared", all.name,
                                     all.trials.size(), to_degrees(all.theta))};
  if (all.stopped)
    out.problems.push_back(
        {"warning", fmt::format("stopped; not tried: {}", fmt::join(all.not_tried, ", "))});
  if (all.least_force < 0) {
    if (!all.stopped) out.problems.push_back({"error", "no drive reaches this fold angle"});
    return out;
  }
  const DriveTrial &force = all.trials[all.least_force], &work = all.trials[all.least_work];
  out.lines = {{"force", fmt::format("least {} N, by {}", format_figures(force.force_N), force.name)},
               {"work", fmt::format("least {} N mm, by {}", format_figures(work.work_Nmm), work.name)}};
  return out;
}

Json drive_trials_json(const DriveTrials& all) {
  Json trials = Json::array();
  for (const DriveTrial& trial : all.trials) trials.push_back(trial_json(trial));
  Json out = {{"schema", "kinetix-drives/1"},
              {"name", all.name},
              {"theta_rad", all.theta},
              {"lever_mm", all.lever_mm},
              {"drives", trials},
              {"least_force", name_of(all, all.least_force)},
              {"least_work", name_of(all, all.least_work)}};
  if (!all.stopped) return out;
  out["stopped"] = true;
  out["not_tried"] = all.not_tried;
  return out;
}

}  // namespace kinetix::app
