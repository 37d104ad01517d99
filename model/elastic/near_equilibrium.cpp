#include "model/elastic/near_equilibrium.hpp"

#include <algorithm>

#include "model/elastic/branch.hpp"
#include "model/elastic/drive_load.hpp"
#include "model/elastic/elastic_system.hpp"

namespace kinetix::model {
namespace {

// Of the whole change, a step. Halved where no equilibrium is near; below the least part, there is none.
constexpr double first_part = 0.25, least_part = 1.0 / 256;

/// A minimum below a state, at the drive's goal; what there is else goes into `why`.
class Settler {
 public:
  Settler(const DrivenLinkage& driven, const Elasticity& elasticity, const EquilibriumPathOptions& options)
      : system_(driven.linkage, elasticity, driven.drive,
                options.planar.value_or(all_vertical(driven.linkage)), options.contact),
        newton_(options.newton),
        unit_(energy_unit(elasticity, driven.linkage.size.edge_mm)) {}

  const ElasticSystem& system() const { return system_; }

  EquilibriumPath settle(const State& start) {
    EquilibriumPath path;
    path.theta = system_.drive().theta();
    path.state = start;
    TangentStiffness tangent(system_.dofs());
    const NewtonResult newton = minimise(system_, path.theta, newton_, path.state, tangent);
    path.iterations = newton.iterations;
    path.gaps = hinge_gaps(system_.structure(), path.state);
    path.steps.push_back(measured(path.state, path.theta, tangent, newton.stable));
    path.multiplier = system_.multiplier();
    if (newton.converged && newton.stable) return path;
    path.stop = EquilibriumPath::Stop::not_converged;
    path.why = newton.converged ? "the equilibrium next to the given state is unstable"
                                : "no equilibrium was found next to the given state";
    return path;
  }

 private:
  EquilibriumStep measured(const State& state, double theta, const TangentStiffness& tangent,
                           bool stable) const {
    const bool plates = system_.drive().kind == LinkageDrive::Kind::plates;
    EquilibriumStep step;
    step.theta = theta;
    step.drive = system_.drive_coordinate(theta);
    step.stable = stable;
    step.load = drive_load(system_, state, theta, tangent, stable) *
                (plates ? unit_ / system_.structure().size.edge_mm : unit_);
    step.energy = system_.elastic_energy(state) * unit_;
    step.gap = hinge_gaps(system_.structure(), state).max;
    step.contacts = static_cast<int>(system_.contacts(state).size());
    return step;
  }

  ElasticSystem system_;
  NewtonOptions newton_;
  double unit_;
};

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
  Settler settler(driven, elasticity, options);
  const double theta = driven.drive.theta();
  const auto exact = Branch(settler.system(), driven.exact, theta, options.side).exact_state(theta);
  return exact ? settler.settle(*exact) : without_equilibrium("no closed form fits the structure");
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
    EquilibriumPath path = Settler(change(next), elasticity, same).settle(last);
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
