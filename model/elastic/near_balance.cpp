#include "model/elastic/near_balance.hpp"

#include <algorithm>

#include "model/elastic/branch.hpp"
#include "model/elastic/elastic_system.hpp"

namespace kinetix {
namespace {

constexpr double first_part = 0.25, least_part = 1.0 / 256;

/// A minimum below a state, at the drive's goal; what there is else goes into `why`.
class Settler {
 public:
  Settler(const Structure& structure, const Elasticity& elasticity, const Drive& drive,
          const LoadPathOptions& options)
      : system_(structure, elasticity, drive, options.planar.value_or(all_vertical(structure)),
                options.contact),
        newton_(options.newton),
        unit_(energy_unit(elasticity, structure.size.edge_mm)) {}

  const ElasticSystem& system() const { return system_; }

  LoadPath settle(const State& start) {
    LoadPath path;
    path.theta = system_.drive().theta();
    path.state = start;
    Tangent tangent(system_.freedoms());
    const NewtonResult newton = minimise(system_, path.theta, newton_, path.state, tangent);
    path.iterations = newton.iterations;
    path.gaps = hinge_gaps(system_.structure(), path.state);
    path.steps.push_back(measured(path.state, path.theta));
    path.steps.back().stable = newton.stable;
    path.multiplier = system_.multiplier();
    if (newton.converged && newton.stable) return path;
    path.stop = LoadPath::Stop::not_converged;
    path.why = newton.converged ? "the balance next to the given state is unstable"
                                : "no balance was found next to the given state";
    return path;
  }

 private:
  LoadStep measured(const State& state, double theta) const {
    const bool plates = system_.drive().kind == Drive::Kind::plates;
    LoadStep step;
    step.theta = theta;
    step.drive = system_.drive_coordinate(theta);
    step.load = system_.load(state, theta) * (plates ? unit_ / system_.structure().size.edge_mm : unit_);
    step.energy = system_.elastic_energy(state) * unit_;
    step.gap = hinge_gaps(system_.structure(), state).max;
    step.contacts = static_cast<int>(system_.contacts(state).size());
    return step;
  }

  ElasticSystem system_;
  NewtonOptions newton_;
  double unit_;
};

void check(const Structure& structure, const Elasticity& elasticity, const Drive& drive,
           const LoadPathOptions& options) {
  options.validate();
  elasticity.validate();
  validate(drive, structure);
}

Structure between(const Structure& before, const Structure& after, double part) {
  if (part >= 1) return after;
  Structure out = after;
  const auto mix = [part](double a, double b) { return a + part * (b - a); };
  for (std::size_t k = 0; k < out.hinges.size(); ++k) {
    const HingeParameters& a = before.hinges[k].parameters;
    HingeParameters& p = out.hinges[k].parameters;
    p = {mix(a.t, p.t), mix(a.alpha, p.alpha), mix(a.beta, p.beta)};
  }
  return out;
}

LoadPath without_balance(const std::string& why) {
  LoadPath path;
  path.stop = LoadPath::Stop::not_converged;
  path.why = why;
  return path;
}

}  // namespace

LoadPath balance_at_closed_form(const Structure& structure, const Elasticity& elasticity, const Drive& drive,
                                const LoadPathOptions& options) {
  check(structure, elasticity, drive, options);
  Settler settler(structure, elasticity, drive, options);
  const auto exact = Branch(settler.system(), drive.theta(), options.side).exact_state(drive.theta());
  return exact ? settler.settle(*exact) : without_balance("no closed form fits the structure");
}

LoadPath follow_change(const Structure& before, const State& state, const Structure& after,
                       const Elasticity& elasticity, const Drive& drive, const LoadPathOptions& options) {
  check(after, elasticity, drive, options);
  LoadPathOptions same = options;
  same.planar = options.planar.value_or(all_vertical(before) && all_vertical(after));
  State last = state;
  int iterations = 0;
  for (double done = 0, part = first_part;;) {
    const double next = std::min(done + part, 1.0);
    const Structure changed = between(before, after, next);
    LoadPath path = Settler(changed, elasticity, drive, same).settle(last);
    path.iterations = iterations += path.iterations;
    if (path.stop != LoadPath::Stop::reached) {
      if ((part /= 2) < least_part) return path;
      continue;
    }
    if (next >= 1) return path;
    last = std::move(path.state);
    done = next;
  }
}

}  // namespace kinetix
