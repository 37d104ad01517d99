#include "sim/equilibrium.hpp"

#include <algorithm>
#include <cmath>

#include "model/closure/closure.hpp"
#include "model/closure/closure_drive.hpp"

namespace kinetix::sim {

double largest_hinge_force(const model::Linkage& structure, const model::State& state,
                           const model::Stiffness& stiffness) {
  const Eigen::VectorXd misfit = closure_residual(structure, state);
  double largest = 0;
  for (int h = 0; h < static_cast<int>(structure.hinges.size()); ++h) {
    const Eigen::Vector3d point = misfit.segment<3>(6 * h),
                          lever = stiffness.reach * misfit.segment<3>(6 * h + 3);
    const double turn = stiffness.law->at(hinge_turn(structure, state, h), stiffness.turn).moment();
    largest = std::max({largest, (point + lever).norm(), (point - lever).norm(), std::abs(turn)});
  }
  return largest;
}

}  // namespace kinetix::sim
