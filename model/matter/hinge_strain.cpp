#include "model/matter/hinge_strain.hpp"

#include <cmath>

#include "model/closure/closure_drive.hpp"

namespace kinetix::model {
namespace {

/// How far apart the two bodies of a hinge carry its point, mm.
double pulled_mm(const Linkage& linkage, const State& state, const RestHinge& hinge) {
  const double edge = linkage.size.edge_mm;
  const Pose &lower = state[hinge.lower], &upper = state[hinge.upper];
  return ((upper.p + edge * (upper.R * hinge.upper_arm)) - (lower.p + edge * (lower.R * hinge.lower_arm)))
      .norm();
}

}  // namespace

double hinge_strain(const MadeHinge& made, const Linkage& linkage, const State& state, int hinge) {
  if (made.kind == HingeKind::pin) return 0;
  return strain(made, std::abs(hinge_turn(linkage, state, hinge))) +
         pulled_mm(linkage, state, linkage.hinges[hinge]) / made.gap_mm;
}

}  // namespace kinetix::model
