#include "model/matter/hinge_strain.hpp"

#include <algorithm>
#include <cmath>

#include "model/closure/closure_drive.hpp"
#include "model/linkage/hinge_mismatch.hpp"

namespace kinetix::model {
double hinge_strain(const MadeHinge& made, const Linkage& linkage, const State& state, int hinge) {
  if (made.kind == HingeKind::pin) return 0;
  const double edge = linkage.size.edge_mm;
  const RestHinge& h = linkage.hinges[hinge];
  const Pose &lower = state[h.lower], &upper = state[h.upper];
  const Eigen::Vector3d pulled_mm = edge * point_mismatch(h, lower, upper, edge).gap;
  const Eigen::Vector3d leant_mm = made.height_mm / 2 * axis_mismatch(h, lower, upper).gap;
  const double most_mm = std::max((pulled_mm + leant_mm).norm(), (pulled_mm - leant_mm).norm());
  return strain(made, std::abs(hinge_turn(linkage, state, hinge))) + most_mm / made.gap_mm;
}

}  // namespace kinetix::model
