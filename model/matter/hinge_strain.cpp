#include "model/matter/hinge_strain.hpp"

#include <cmath>

#include "model/closure/closure_drive.hpp"
#include "model/linkage/hinge_mismatch.hpp"

namespace kinetix::model {
double hinge_strain(const MadeHinge& made, const Linkage& linkage, const State& state, int hinge) {
  if (made.kind == HingeKind::pin) return 0;
  const double edge = linkage.size.edge_mm;
  const RestHinge& h = linkage.hinges[hinge];
  const double pulled_mm = edge * point_mismatch(h, state[h.lower], state[h.upper], edge).gap.norm();
  return strain(made, std::abs(hinge_turn(linkage, state, hinge))) + pulled_mm / made.gap_mm;
}

}  // namespace kinetix::model
