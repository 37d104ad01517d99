#include "model/elastic/path/near_equilibrium.hpp"

#include <algorithm>

#include "model/elastic/path/closed_form.hpp"
#include "model/elastic/path/measured_system.hpp"

namespace kinetix::model {
namespace {

// Fractions of the whole change: first step, halved if no equilibrium is near, and least step.
constexpr double first_part = 0.25, least_part = 1.0 / 256;

/// Finds the minimum near a state, at the drive's goal.
EquilibriumPath settled(const DrivenLinkage& driven, const Elasticity& elasticity,
                        const EquilibriumPathOptions& options, const State& start) {
  MeasuredSystem system(driven.linkage, elasticity, driven.drive, options);
  EquilibriumPath path;
  path.theta = system.elastic.drive().theta();
  path.state = start;
  const NewtonResult newton =
      minimise(system.elastic, path.theta, options.newton, path.state, system.tangent);
  path.iterations = newton.iterations;
  path.steps.push_back(system.measured(path.state, path.theta, newton.stable));
  path.gaps = hinge_gaps(system.elastic.structure(), path.state);
  path.multiplier = system.elastic.multiplier();
  path.off_closed_form = ClosedForm(system.elastic, driven.exact).is_far(path.state, path.theta);
  const bool crosses = newton.converged && system.elastic.newly_cross(start, path.state);
  if (newton.converged && newton.stable && !crosses) return path;
  path.stop = EquilibriumPath::Stop::not_converged;
  if (crosses) {
    path.why = "next to the given state walls would have to pass through each other";
    return path;
  }
  path.why = newton.converged ? "the equilibrium next to the given state is unstable"
                              : "no equilibrium was found next to the given state";
  return path;
}

void check(const Elasticity& elasticity, const EquilibriumPathOptions& options) {
  options.validate();
  elasticity.validate();
}

EquilibriumPath without_equilibrium(const std::string& why) {
  EquilibriumPath path;
  path.stop = EquilibriumPath::Stop::not_converged;
  path.why = why;
  return path;
}

}  // namespace

EquilibriumPath equilibrium_at_closed_form(const DrivenLinkage& driven, const Elasticity& elasticity,
                                           const EquilibriumPathOptions& options) {
  check(elasticity, options);
  MeasuredSystem system(driven.linkage, elasticity, driven.drive, options);
  const auto exact = ClosedForm(system.elastic, driven.exact).at(driven.drive.theta());
  return exact ? settled(driven, elasticity, options, *exact)
               : without_equilibrium("no closed form fits the structure");
}

EquilibriumPath follow_change(const State& state, const std::function<DrivenLinkage(double)>& change,
                              const Elasticity& elasticity, const EquilibriumPathOptions& options) {
  check(elasticity, options);
  EquilibriumPathOptions same = options;
  same.planar = options.planar.value_or(all_vertical(change(0).linkage) && all_vertical(change(1).linkage));
  State last = state;
  int iterations = 0;
  for (double done = 0, part = first_part;;) {
    const double next = std::min(done + part, 1.0);
    const DrivenLinkage changed = change(next);
    EquilibriumPath path = settled(changed, elasticity, same, last);
    path.iterations = iterations += path.iterations;
    if (path.stop != EquilibriumPath::Stop::reached) {
      if ((part /= 2) < least_part) return path;
      continue;
    }
    if (next >= 1) return path;
    last = std::move(path.state);
    done = next;
  }
}

}  // namespace kinetix::model
