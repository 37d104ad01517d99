#include "app/result/stable_states_json.hpp"

#include <nlohmann/json.hpp>

#include "app/result/state_json.hpp"
#include "model/closure/drive_theta.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

void add_stable_states(const Run& run, Json& equilibrium) {
  const model::StableStates& stable = run.equilibrium->stable;
  const model::Linkage structure = run.design.structure;
  Json states = Json::array(), barriers = Json::array();
  for (const model::StableState& s : stable.states)
    states.push_back({{"theta_rad", s.theta},
                      {"drive", coordinate_of(run.equilibrium->drive, structure, s.state)},
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
