#include "model/hinge/hinge_law.hpp"

#include <cmath>

#include "model/base/angle.hpp"

namespace kinetix::model {

TurnResponse SetHinge::at(double turn, double k_turn) const {
  return LinearHinge().at(std::remainder(turn - set_, 2 * pi), k_turn);
}

const std::shared_ptr<const HingeLaw>& linear_hinge() {
  static const std::shared_ptr<const HingeLaw> law = std::make_shared<LinearHinge>();
  return law;
}

}  // namespace kinetix::model
