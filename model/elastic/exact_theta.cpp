#include "model/elastic/exact_theta.hpp"

#include <algorithm>
#include <cmath>

#include "model/base/angle.hpp"
#include "model/closure/closure_drive.hpp"

namespace kinetix::model {
namespace {

constexpr int scan_steps = 100;  // from flat to the rest angle of the springs, to bracket the first minimum
constexpr double widest = 89.9 * pi / 180;       // rad; at 90 deg every cell is closed
constexpr double accuracy = 1e-8;                // rad: closer to a minimum, energies differ only by rounding
const double golden = (std::sqrt(5.0) - 1) / 2;  // golden section: the next bracket has the same proportions

/// Energy of hinges and springs along the closed form, N mm.
class FoldEnergy {
 public:
  FoldEnergy(const DrivenLinkage& driven, const Elasticity& elasticity)
      : driven_(driven), elasticity_(elasticity) {}

  double operator()(double theta) const {
    const Linkage& linkage = driven_.linkage;
    const State state = driven_.exact.at(theta);
    double sum = 0;
    for (std::size_t h = 0; h < linkage.hinges.size(); ++h) {
      const Elasticity& own = elasticity_.of(h);
      sum += own.law->at(hinge_turn(linkage, state, static_cast<int>(h)), own.k_turn).energy;
    }
    for (const int h : driven_.drive.springs) {
      const int sense = linkage.bodies[linkage.hinges[h].lower].sense;
      const double off = hinge_turn(linkage, state, h) - turn_at_theta(sense, driven_.drive.theta());
      sum += 0.5 * driven_.drive.k_spring * off * off;
    }
    return sum;
  }

 private:
  const DrivenLinkage& driven_;
  const Elasticity& elasticity_;
};

/// Returns the minimum in a bracket by golden-section search.
double minimum_between(const FoldEnergy& energy, double a, double b) {
  double low = b - golden * (b - a), high = a + golden * (b - a);
  double at_low = energy(low), at_high = energy(high);
  while (std::abs(b - a) > accuracy) {
    if (at_low < at_high) {
      b = high, high = low, at_high = at_low;
      at_low = energy(low = b - golden * (b - a));
    } else {
      a = low, low = high, at_low = at_high;
      at_high = energy(high = a + golden * (b - a));
    }
  }
  return (a + b) / 2;
}

}  // namespace

double exact_theta(const DrivenLinkage& driven, const Elasticity& elasticity) {
  if (driven.drive.acts_from_outside()) return driven.exact.theta_of(driven.drive);
  const FoldEnergy energy(driven, elasticity);
  const double goal = driven.drive.theta(), step = goal / scan_steps;
  if (goal == 0) return 0;
  double last = energy(0);
  for (int k = 1; std::abs(k * step) <= widest; ++k) {
    const double now = energy(k * step);
    if (!(now < last)) return minimum_between(energy, std::max(k - 2, 0) * step, k * step);
    last = now;
  }
  return std::copysign(widest, goal);
}

}  // namespace kinetix::model
