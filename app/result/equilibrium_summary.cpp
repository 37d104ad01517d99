#include "app/result/equilibrium_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/result/effort.hpp"
#include "app/result/equilibrium_json.hpp"

namespace kinetix::app {
namespace {

// Of a summary: what a person reads through in a terminal. result.json has them all.
constexpr std::size_t most_events = 12, most_states = 6;

std::string load_text(const Equilibrium& equilibrium, const model::EquilibriumStep& step) {
  return fmt::format("{:.4g} {}", step.load, equilibrium.drive.load_unit());
}

std::string theta_text(const Equilibrium& equilibrium, const model::EquilibriumStep& step) {
  return fmt::format("theta {:.2f} deg{}", to_degrees(step.theta),
                     equilibrium.drive.tells_fold() ? "" : " of the drive");
}

std::string effort_text(const Equilibrium& equilibrium) {
  const char* gripped = equilibrium.path.let_go > 0 ? " (by plates that grip until the end)" : "";
  return fmt::format("{:.4g} {}{}: a matter for {}", largest_load(equilibrium.path),
                     equilibrium.drive.load_unit(), gripped, effort_of(equilibrium));
}

std::string drive_text(const Equilibrium& equilibrium, const model::EquilibriumStep& step) {
  const std::string words = equilibrium.drive.coordinate_words(), unit = equilibrium.drive.coordinate_unit();
  if (unit == "rad") return fmt::format("{} {:.4g} deg", words, to_degrees(step.drive));
  return fmt::format("{} {:.4g}{}", words, step.drive, unit == "mm" ? " mm" : "");
}

/// What the load is, where its unit does not say it.
std::string load_words(const Equilibrium& equilibrium) {
  if (equilibrium.drive.only_pulls())
    return equilibrium.path.steps.back().load < 0 ? "the cord is slack, it would have to push: tension "
                                                  : "tension ";
  if (equilibrium.drive.springs.empty()) return "";
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
                                  ? fmt::format(", {:.4g} in the drive's springs", path.steps.back().springs)
                                  : "";
  return fmt::format("{:.4g} N mm ({:.4g} in stretch, {:.4g} in rotation, {:.2g} in contact{})", total,
                     sum.stretch, sum.turn, contact, springs);
}

std::string press_text(const Equilibrium& equilibrium) {
  const model::GrippedRows& rows = equilibrium.drive.gripped;
  return fmt::format("press without gripping: {} of {} bodies of their rows are let go",
                     equilibrium.path.let_go, rows[0].size() + rows[1].size());
}

std::string stretch_text(const Run& run) {
  const model::HingeGaps& gaps = run.equilibrium->path.gaps;
  std::string text = fmt::format("largest {:.2e} cell edges ({:.3g} mm)", gaps.max,
                                 gaps.max * run.design.structure.size().edge_mm);
  if (gaps.worst_hinge >= 0 && gaps.max > 0)
    text += (run.design.structure.assembly() ? ", at hinge " : ", on wall ") +
            wall_name(run.design.structure, gaps.worst_hinge);
  return text;
}

std::string stable_text(const model::StableStates& stable) {
  std::string text = fmt::format("{} states: flat", stable.states.size());
  for (std::size_t k = 1; k < std::min(most_states, stable.states.size()); ++k)
    text += fmt::format(", theta {:.2f} deg ({:.3g} N mm)", to_degrees(stable.states[k].theta),
                        stable.states[k].energy);
  if (stable.states.size() > most_states) text += ", and more in result.json";
  for (std::size_t k = 0; k < std::min(most_states, stable.barriers.size()); ++k)
    text += fmt::format("; barrier {:.4g} N mm at theta {:.2f} deg", stable.barriers[k].energy,
                        to_degrees(stable.barriers[k].theta));
  return text;
}

}  // namespace

std::vector<std::array<std::string, 2>> equilibrium_lines(const Run& run) {
  const Equilibrium& equilibrium = *run.equilibrium;
  const model::EquilibriumPath& path = equilibrium.path;
  const model::EquilibriumStep& last = path.steps.back();
  std::vector<std::array<std::string, 2>> lines;
  if (!equilibrium.reached()) lines.push_back({"STOPPED", in_words(path.stop) + ": " + path.why});
  lines.push_back({"load", load_words(equilibrium) + load_text(equilibrium, last) + " at " +
                               drive_text(equilibrium, last) +
                               (equilibrium.reached() ? ": the drive reached its goal" : "")});
  if (equilibrium.is_on_the_other_side(run.theta))
    lines.push_back({"OTHER SIDE", describe_other_side(equilibrium, run.theta)});
  if (equilibrium.drive.acts_from_outside())
    lines.push_back({"effort", "at most " + effort_text(equilibrium)});
  if (equilibrium.drive.press && equilibrium.reached()) lines.push_back({"plates", press_text(equilibrium)});
  lines.push_back({"energy", energy_text(path)});
  lines.push_back({"stretch", stretch_text(run)});
  for (std::size_t k = 0; k < std::min(most_events, path.events.size()); ++k) {
    const model::PathEvent& event = path.events[k];
    lines.push_back(
        {"event",
         fmt::format("{} at {}, {}, load {}: {}", to_string(event.kind), drive_text(equilibrium, event.at),
                     theta_text(equilibrium, event.at), load_text(equilibrium, event.at), event.what)});
  }
  if (path.events.size() > most_events)
    lines.push_back({"", fmt::format("and {} more events in result.json", path.events.size() - most_events)});
  if (equilibrium.stable.states.size() > 1) lines.push_back({"stable", stable_text(equilibrium.stable)});
  for (const std::string& why : equilibrium.stable.unresolved) lines.push_back({"release", why});
  if (equilibrium.from_exact)
    lines.push_back({"exact", fmt::format("rms {:.1e} cell edges from the closed form of the same drive",
                                          equilibrium.from_exact->rms)});
  return lines;
}

}  // namespace kinetix::app
