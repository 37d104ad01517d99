#include "sim/equilibrium.hpp"

#include <algorithm>
#include <cmath>

#include "model/closure/closure.hpp"
#include "model/closure/closure_drive.hpp"
#include "sim/framed_points.hpp"

namespace kinetix::sim {

double largest_hinge_force(const model::Linkage& structure, const model::State& state,
                           const model::Stiffness& stiffness) {
  const Eigen::VectorXd misfit = closure_residual(structure, state);
  double largest = 0;
  for (int h = 0; h < static_cast<int>(structure.hinges.size()); ++h) {
    const model::Stiffness& k = stiffness.of(h);
    const model::RestHinge& hinge = structure.hinges[h];
    Eigen::Vector3d point = misfit.segment<3>(6 * h), lever = k.reach * misfit.segment<3>(6 * h + 3);
    if (!k.ratios.are_one()) {
      const HingeDirections at = hinge_directions(hinge, state[hinge.lower], state[hinge.upper]);
      point = pull(k.ratios, at, point);
      lever = pull(k.ratios, at, lever);
    }
    const double turn = k.law->at(hinge_turn(structure, state, h), k.turn).moment();
    largest = std::max({largest, (point + lever).norm(), (point - lever).norm(), std::abs(turn)});
  }
  return largest;
}

}  // namespace kinetix::sim
