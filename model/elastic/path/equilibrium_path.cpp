#include "model/elastic/path/equilibrium_path.hpp"

#include <algorithm>
#include <cmath>

#include "model/base/invalid_input.hpp"
#include "model/elastic/path/path_tracer.hpp"
#include "model/elastic/path/pressed_path.hpp"

namespace kinetix::model {

void EquilibriumPathOptions::validate() const {
  require("side", side, side == 1 || side == -1, "1 or -1");
  require("first_step", first_step, first_step > 0 && first_step <= 0.5, "in (0, 0.5] rad");
  require("longest_step", longest_step, longest_step > 0 && longest_step <= 0.5, "in (0, 0.5] rad");
  require("longest_step_touching", longest_step_touching,
          longest_step_touching > 0 && longest_step_touching <= 0.5, "in (0, 0.5] rad");
  require("least_step", least_step,
          least_step > 0 && least_step <= std::min({first_step, longest_step, longest_step_touching}),
          "above 0 and at most first_step, longest_step and longest_step_touching");
  require("longest_jump", longest_jump, longest_jump > 0, "positive");
  require("gap_limit", gap_limit, gap_limit > 0, "positive");
}

double largest_load(const EquilibriumPath& path) {
  double largest = 0;
  for (const EquilibriumStep& step : path.steps)
    if (!(std::abs(step.load) <= largest)) largest = std::abs(step.load);
  return largest;
}

EquilibriumPath trace_equilibrium(const DrivenLinkage& driven, const Elasticity& elasticity,
                                  const EquilibriumPathOptions& options,
                                  const std::function<void(const EquilibriumStep&, const State&)>& frame) {
  options.validate();
  elasticity.validate();
  if (driven.drive.press) return trace_pressed(driven, elasticity, options, frame);
  return PathTracer(driven, elasticity, options, frame).run();
}

}  // namespace kinetix::model
