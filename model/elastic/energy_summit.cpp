#include "model/elastic/energy_summit.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "model/elastic/drive_load.hpp"

namespace kinetix::model {
namespace {

constexpr double accuracy = 1e-7;    // rad of theta: the energy at a maximum is off by its square alone
constexpr double vanishing = 1e-4;   // of the larger load at both ends: more is left where the path jumps
constexpr int most_equilibria = 60;  // equilibria: bisection alone comes from 1 rad to the accuracy with 24

class Summit {
 public:
  Summit(const Linkage& structure, const Elasticity& elasticity, const LinkageDrive& drive,
         const EquilibriumPathOptions& options)
      : system_(structure, elasticity, drive, options.planar.value_or(all_vertical(structure)),
                options.contact),
        tangent_(system_.dofs()),
        newton_(options.newton),
        unit_(energy_unit(elasticity, structure.size.edge_mm)),
        load_unit_(drive.kind == LinkageDrive::Kind::plates ? unit_ / structure.size.edge_mm : unit_) {}

  /// Regula falsi with the Illinois rule.
  EnergyBarrier of(const EnergyTurn& turn) {
    Side low{turn.before, turn.before.step.load}, high{turn.after, turn.after.step.load};
    const double scale = std::max(std::abs(low.load), std::abs(high.load));
    EnergyBarrier best = barrier(low.at.step.energy > high.at.step.energy ? low.at.step : high.at.step);
    if ((low.load > 0) == (high.load > 0)) return best;
    for (int k = 0; k < most_equilibria; ++k) {
      const double theta = (low.theta() * high.load - high.theta() * low.load) / (high.load - low.load);
      const double from_low = std::abs(theta - low.theta()), from_high = std::abs(theta - high.theta());
      const auto next = equilibrium(theta, from_low < from_high ? low.at.state : high.at.state);
      if (!next) return best;
      if (next->step.energy > best.energy) best = barrier(next->step);
      if (std::min(from_low, from_high) <= accuracy) {
        best.balanced = std::abs(next->step.load) <= vanishing * scale;
        return best;
      }
      const bool is_low = (next->step.load > 0) == (low.load > 0);
      replace(is_low ? low : high, is_low ? high : low, *next);
    }
    return best;
  }

 private:
  struct Side {
    DrivenState at;
    double load;
    bool kept = false;  ///< the other side moved last
    double theta() const { return at.step.theta; }
  };

  static void replace(Side& side, Side& other, DrivenState next) {
    if (other.kept) other.load /= 2;
    other.kept = true;
    const double load = next.step.load;
    side = {std::move(next), load, false};
  }

  static EnergyBarrier barrier(const EquilibriumStep& step) {
    return {0, 0, step.energy, step.theta, step.drive, false};
  }

  std::optional<DrivenState> equilibrium(double theta, State state) {
    system_.place(theta, state);
    const NewtonResult newton = minimise(system_, theta, newton_, state, tangent_);
    if (!newton.converged) return {};
    EquilibriumStep step;
    step.theta = theta;
    step.drive = system_.drive_coordinate(theta);
    step.load = drive_load(system_, state, theta, tangent_, newton.stable) * load_unit_;
    step.energy = system_.elastic_energy(state) * unit_;
    return DrivenState{step, std::move(state)};
  }

  ElasticSystem system_;
  TangentStiffness tangent_;
  NewtonOptions newton_;
  double unit_, load_unit_;
};

}  // namespace

EnergyBarrier energy_summit(const Linkage& structure, const Elasticity& elasticity, const LinkageDrive& drive,
                            const EquilibriumPathOptions& options, const EnergyTurn& turn) {
  return Summit(structure, elasticity, drive, options).of(turn);
}

}  // namespace kinetix::model
