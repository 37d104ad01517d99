#include "app/equilibrium_json.hpp"

namespace kinetix {
namespace {

using Json = nlohmann::ordered_json;

bool by_plates(const Equilibrium& balance) { return balance.drive.kind == Drive::Kind::plates; }

Json step_json(const LoadStep& step, bool plates) {
  return {{"theta_rad", step.theta},
          {"drive", step.drive},
          {"drive_unit", plates ? "compression" : "rad"},
          {"load", step.load},
          {"load_unit", plates ? "N" : "N mm"},
          {"energy_Nmm", step.energy},
          {"gap", step.gap},
          {"contacts", step.contacts},
          {"stable", step.stable}};
}

Json event_json(const PathEvent& event) {
  return {{"kind", to_string(event.kind)}, {"theta_rad", event.at.theta}, {"since_rad", event.since},
          {"drive", event.at.drive},       {"load", event.at.load},       {"what", event.what}};
}

}  // namespace

Json equilibrium_json(const Equilibrium& balance) {
  const LoadPath& path = balance.path;
  const Elasticity& e = balance.elasticity;
  Json steps = Json::array(), events = Json::array(), energies = Json::array();
  for (const LoadStep& step : path.steps) steps.push_back(step_json(step, by_plates(balance)));
  for (const PathEvent& event : path.events) events.push_back(event_json(event));
  for (const HingeEnergy& energy : path.hinge_energies)
    energies.push_back({{"stretch", energy.stretch}, {"turn", energy.turn}});
  return {
      {"stop", to_string(path.stop)},
      {"why", path.why},
      {"planar", path.planar},
      {"goal_rad", balance.drive.theta()},
      {"iterations", path.iterations},
      {"stiffness",
       {{"k_point", e.k_point}, {"k_turn", e.k_turn}, {"reach_mm", e.reach_mm}, {"k_contact", e.k_contact}}},
      {"path", steps},
      {"events", events},
      {"hinge_energy_Nmm", energies}};
}

void add_equilibrium_metrics(const Equilibrium& balance, Json& metrics) {
  const LoadStep& last = balance.path.steps.back();
  metrics["reached"] = balance.reached();
  metrics[by_plates(balance) ? "compression" : "drive_rad"] = last.drive;
  metrics[by_plates(balance) ? "load_N" : "load_Nmm"] = last.load;
  metrics["energy_Nmm"] = last.energy;
  metrics["hinge_gap_max"] = balance.path.gaps.max;
  metrics["hinge_gap_rms"] = balance.path.gaps.rms;
  if (!balance.from_exact) return;
  metrics["exact_rms"] = balance.from_exact->rms;
  metrics["exact_max"] = balance.from_exact->max;
}

}  // namespace kinetix
