#include "app/result/drive_trials_summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/result/equilibrium_summary.hpp"
#include "model/base/angle.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

// Of a force or work: drives that differ by less end at thetas that differ by as much, or stretch hinges as little.
constexpr double alike = 0.02;

std::string path_text(const DriveTrial& trial) {
  const std::string snaps = trial.snaps == 0   ? "no snap"
                            : trial.snaps == 1 ? "1 snap"
                                               : fmt::format("{} snaps", trial.snaps);
  if (!trial.reached()) return app::in_words(trial.path.stop) + ", " + snaps;
  return snaps + (trial.path.steps.back().stable ? ", stable" : ", UNSTABLE") +
         (trial.path.off_closed_form ? ", off the closed form" : "") +
         (trial.at_goal ? "" : ", NOT at that theta");
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

/// The others that hold and need hardly more.
std::string alike_text(const DriveTrials& all, int best, double DriveTrial::*number) {
  std::string names;
  for (int k = 0; k < static_cast<int>(all.trials.size()); ++k)
    if (k != best && all.trials[k].holds() && all.trials[k].*number <= (1 + alike) * all.trials[best].*number)
      names += (names.empty() ? "" : ", ") + all.trials[k].name;
  return names.empty() ? "" : fmt::format("; within {:g} %: {}", 100 * alike, names);
}

/// The drives that need least; of the others nothing is known where the trials were stopped.
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
  return all.stopped ? stopped : "  none of them takes the sheet there\n";
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

std::string summary(const DriveTrials& all) {
  std::size_t width = 5;  // of the heading
  for (const DriveTrial& trial : all.trials) width = std::max(width, trial.name.size());
  std::string text = fmt::format(
      "{}: drives to theta {:.2f} deg, slowly; moments count as forces at a lever of one cell edge, {:g} "
      "mm\n",
      all.name, to_degrees(all.theta), all.lever_mm);
  text += fmt::format("  {:<{}}  {:>15}  {:>10}  {:>10}  {:>10}  {:>6}  {}\n", "drive", width, "largest load",
                      "as force N", "work N mm", "energy", "theta", "path and end");
  for (const DriveTrial& trial : all.trials) text += trial_line(trial, width);
  return text + verdict(all);
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
