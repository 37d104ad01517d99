#include "sim/equilibrium.hpp"

#include <algorithm>
#include <cmath>

#include "model/closure/closure.hpp"
#include "model/closure/closure_drive.hpp"
#include "sim/joints/framed_points.hpp"

namespace kinetix::sim {

double largest_hinge_force(const model::Linkage& structure, const model::State& state,
                           const model::Stiffness& stiffness) {
  double largest = 0;
  for (int h = 0; h < static_cast<int>(structure.hinges.size()); ++h) {
    const model::Stiffness& k = stiffness.of(h);
    const model::RestHinge& hinge = structure.hinges[h];
    const HingePull pull =
        hinge_pull(hinge, k, state[hinge.lower], state[hinge.upper], structure.size.edge_mm);
    const Eigen::Vector3d point = pull.point / 2, lever = pull.axis / (2 * k.reach);
    const double turn = k.law->at(hinge_turn(structure, state, h), k.turn).moment();
    largest = std::max({largest, (point + lever).norm(), (point - lever).norm(), std::abs(turn)});
  }
  return largest;
}

}  // namespace kinetix::sim
