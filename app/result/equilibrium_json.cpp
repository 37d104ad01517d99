#include "app/result/equilibrium_json.hpp"

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/result/effort.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

Json step_json(const model::EquilibriumStep& step, const model::LinkageDrive& drive) {
  return {{"theta_rad", step.theta},
          {"drive", step.drive},
          {"drive_unit", drive.coordinate_unit()},
          {"load", step.load},
          {"load_unit", drive.load_unit()},
          {"energy_Nmm", step.energy},
          {"gap", step.gap},
          {"contacts", step.contacts},
          {"stable", step.stable}};
}

Json event_json(const model::PathEvent& event) {
  return {{"kind", to_string(event.kind)}, {"theta_rad", event.at.theta}, {"since_rad", event.since},
          {"drive", event.at.drive},       {"load", event.at.load},       {"what", event.what}};
}

/// Adds the stiffness terms of hinges that are not just two springs k_point.
void add_directions(const model::Elasticity& e, Json& stiffness) {
  const model::HingeStiffness k = stiffness_of(e);
  if (!e.ratios.are_one() || !e.tilt.are_by_reach())
    stiffness.update({{"axial", k.axial}, {"shear", k.shear}, {"along", k.along}});
  if (k.rock) stiffness["rock"] = *k.rock;
  if (k.twist) stiffness["twist"] = *k.twist;
  if (e.play_mm > 0) stiffness["play_mm"] = e.play_mm;
}

std::string change_text(const ElasticResult& matter) {
  return fmt::format("tilts changed by up to {:.2f} deg, theta by {:.2f} deg, in {} steps: {}",
                     to_degrees(matter.largest_change), to_degrees(matter.theta_change), matter.rounds,
                     matter.why);
}

}  // namespace

double mean_moment(const Equilibrium& equilibrium) {
  return equilibrium.path.steps.back().load / static_cast<double>(equilibrium.drive.springs.size());
}

Json equilibrium_json(const Equilibrium& equilibrium) {
  const model::EquilibriumPath& path = equilibrium.path;
  const model::Elasticity& e = equilibrium.elasticity;
  Json steps = Json::array(), events = Json::array(), energies = Json::array();
  Json stiffness = {
      {"k_point", e.k_point}, {"k_turn", e.k_turn}, {"reach_mm", e.reach_mm}, {"k_contact", e.k_contact}};
  if (e.each.empty()) add_directions(e, stiffness);
  for (const model::EquilibriumStep& step : path.steps) steps.push_back(step_json(step, equilibrium.drive));
  for (const model::PathEvent& event : path.events) events.push_back(event_json(event));
  for (const model::HingeEnergy& energy : path.hinge_energies)
    energies.push_back({{"stretch", energy.stretch}, {"turn", energy.turn}});
  Json json = {{"stop", to_string(path.stop)},
               {"why", path.why},
               {"effort", effort_of(equilibrium)},
               {"planar", path.planar},
               {"goal_rad", equilibrium.drive.theta()},
               {"iterations", path.iterations},
               {"stiffness", stiffness},
               {"path", steps},
               {"events", events},
               {"hinge_energy_Nmm", energies}};
  if (!equilibrium.drive.acts_from_outside())
    json["shape_memory"] = {{"springs", equilibrium.drive.springs.size()},
                            {"k_turn", equilibrium.drive.k_spring},
                            {"energy_Nmm", path.steps.back().springs},
                            {"moment_mean_Nmm", mean_moment(equilibrium)}};
  return json;
}

void add_equilibrium_metrics(const Equilibrium& equilibrium, Json& metrics) {
  const model::EquilibriumStep& last = equilibrium.path.steps.back();
  metrics["reached"] = equilibrium.reached();
  metrics[equilibrium.drive.coordinate_name()] = last.drive;
  metrics[equilibrium.drive.has_force() ? "load_N" : "load_Nmm"] = last.load;
  if (equilibrium.drive.has_force()) metrics["force_N"] = largest_load(equilibrium.path);
  metrics["energy_Nmm"] = last.energy;
  metrics["hinge_gap_max"] = equilibrium.path.gaps.max;
  metrics["hinge_gap_rms"] = equilibrium.path.gaps.rms;
  if (!equilibrium.from_exact) return;
  metrics["exact_rms"] = equilibrium.from_exact->rms;
  metrics["exact_max"] = equilibrium.from_exact->max;
}

Json matter_json(const ElasticResult& matter) {
  return {{"exact_mm", matter.exact_mm},
          {"before_mm", matter.before_mm},
          {"after_mm", matter.after_mm},
          {"tolerance_mm", matter.tolerance_mm},
          {"largest_change_rad", matter.largest_change},
          {"theta_change_rad", matter.theta_change},
          {"rounds", matter.rounds},
          {"why", matter.why}};
}

std::vector<SummaryLine> matter_lines(const Run& run) {
  if (!run.matter) return {};
  const ElasticResult& matter = *run.matter;
  if (!std::isfinite(matter.after_mm)) return {{"matter", "NO EQUILIBRIUM: " + matter.why}};
  return {
      {"matter",
       fmt::format("with its hinges as made, points of the sheet are {:.3g} mm off {} (rms), where those of "
                   "the exact design would be {:.3g} mm off; its prints are allowed {:.3g} mm",
                   matter.after_mm, run.judged_against, matter.before_mm, matter.tolerance_mm)},
      {"", change_text(matter)}};
}

}  // namespace kinetix::app
