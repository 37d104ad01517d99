#include "model/matter/hinge_strain.hpp"

#include <algorithm>
#include <cmath>

#include "model/closure/closure_drive.hpp"
#include "model/linkage/hinge_mismatch.hpp"

namespace kinetix::model {

double edge_stretch_mm(const Linkage& linkage, const State& state, int hinge, double height_mm) {
  const double edge = linkage.size.edge_mm;
  const RestHinge& h = linkage.hinges[hinge];
  const Pose &lower = state[h.lower], &upper = state[h.upper];
  const Eigen::Vector3d pulled_mm = edge * point_mismatch(h, lower, upper, edge).gap;
  const Eigen::Vector3d leant_mm = height_mm / 2 * axis_mismatch(h, lower, upper).gap;
  return std::max((pulled_mm + leant_mm).norm(), (pulled_mm - leant_mm).norm());
}

double hinge_strain(const MadeHinge& made, const Linkage& linkage, const State& state, int hinge) {
  if (made.kind == HingeKind::pin) return 0;
  return strain(made, std::abs(hinge_turn(linkage, state, hinge))) +
         edge_stretch_mm(linkage, state, hinge, made.height_mm) / made.gap_mm;
}

std::optional<StrainedHinge> most_strained(const Linkage& linkage, const State& state,
                                           const std::function<const MadeHinge*(int)>& made) {
  std::optional<StrainedHinge> worst;
  for (int h = 0; h < static_cast<int>(linkage.hinges.size()); ++h) {
    const MadeHinge* const hinge = made(h);
    if (!hinge) continue;
    const StrainedHinge one{h, hinge_strain(*hinge, linkage, state, h), hinge->material.strain_max};
    if (one.strain <= one.borne) continue;
    if (!worst || one.share() > worst->share()) worst = one;
  }
  return worst;
}

}  // namespace kinetix::model
