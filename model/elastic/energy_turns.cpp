#include "model/elastic/energy_turns.hpp"

#include <utility>

namespace kinetix::model {

void EnergyTurns::see(const EquilibriumStep& step, const State& state) {
  DrivenState now{step, state};
  if (std::exchange(started_, true)) {
    const double slope = step.load * (step.drive - last_.step.drive);
    const bool fell = step.energy < last_.step.energy;
    if (slope_ > 0 && (slope < 0 || fell)) turns_.push_back({true, last_, now});
    if (slope > 0 && (slope_ < 0 || (slope_ > 0 && fell))) turns_.push_back({false, last_, now});
    slope_ = slope;
  }
  last_ = std::move(now);
}

}  // namespace kinetix::model
