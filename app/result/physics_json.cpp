#include "app/result/physics_json.hpp"

#include <nlohmann/json.hpp>

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

Json comparison_json(const model::EquilibriumComparison& c) {
  return {{"outcome", to_string(c.outcome)}, {"why", c.why},
          {"rms", c.distance.rms},           {"rms_from_balance", c.from_equilibrium.rms},
          {"energy_Nmm", c.energy},          {"model_energy_Nmm", c.reference_energy}};
}

}  // namespace

Json physics_json(const Verification& v) {
  Json out = {{"status", to_string(v.physics.status)},
              {"why", v.physics.why},
              {"steps", v.physics.steps},
              {"simulated_s", v.physics.simulated_s},
              {"seconds", v.physics.seconds},
              {"unrest", v.physics.residual_motion},
              {"options",
               {{"step_s", v.options.step_s},
                {"reach", v.options.reach},
                {"contact", v.options.contact},
                {"elastic", v.options.elastic.has_value()},
                {"planar", v.options.planar}}}};
  if (v.equilibrium) out["comparison"] = comparison_json(*v.equilibrium);
  return out;
}

}  // namespace kinetix::app
