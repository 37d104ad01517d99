#include "app/result/stable_states_json.hpp"

#include <nlohmann/json.hpp>

#include "app/result/state_json.hpp"
#include "model/closure/closure_drive.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/linkage/actuators.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

Eigen::Vector3d middle(const std::vector<int>& bodies, const model::State& state) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int body : bodies) sum += state[body].p;
  return sum / static_cast<double>(bodies.size());
}

double compression(const model::Linkage& structure, const model::LinkageDrive& drive,
                   const model::State& state) {
  const model::GrippedRows& rows = drive.gripped;
  const auto apart = [&](const model::State& s) { return (middle(rows[1], s) - middle(rows[0], s)).norm(); };
  return 1 - apart(state) / apart(rest_state(structure));
}

/// Where the drive would be in a state that it does not hold.
double drive_in(const model::Linkage& structure, const model::LinkageDrive& drive,
                const model::State& state) {
  if (drive.kind == model::LinkageDrive::Kind::plates) return compression(structure, drive, state);
  if (drive.pulls_cord()) return drive.rest_mm - cord_length(structure, drive.through, state);
  if (drive.heats_springs()) return 2 * mean_theta(structure, state);
  return hinge_turn(structure, state, drive.hinge);
}

}  // namespace

void add_stable_states(const Run& run, Json& equilibrium) {
  const model::StableStates& stable = run.equilibrium->stable;
  const model::Linkage structure = run.design.structure;
  Json states = Json::array(), barriers = Json::array();
  for (const model::StableState& s : stable.states)
    states.push_back({{"theta_rad", s.theta},
                      {"drive", drive_in(structure, run.equilibrium->drive, s.state)},
                      {"energy_Nmm", s.energy},
                      {"hinge_gap_max", s.gaps.max},
                      {"how", s.how},
                      {"poses", poses_json(s.state)}});
  for (const model::EnergyBarrier& b : stable.barriers)
    barriers.push_back({{"between", {b.from, b.to}},
                        {"energy_Nmm", b.energy},
                        {"theta_rad", b.theta},
                        {"drive", b.drive},
                        {"balanced", b.load_vanishes}});
  equilibrium["stable_states"] = states;
  equilibrium["energy_barriers"] = barriers;
  equilibrium["unresolved_releases"] = stable.unresolved;
}

}  // namespace kinetix::app
