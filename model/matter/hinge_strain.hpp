#pragma once

#include <functional>
#include <optional>

#include "model/linkage/state.hpp"
#include "model/matter/made_hinge.hpp"

namespace kinetix::model {

/// What the upper or lower edge of a block or film, half its height from the middle, is pulled apart or pressed together by
/// in a state, the larger of the two, mm.
double edge_stretch_mm(const Linkage& linkage, const State& state, int hinge, double height_mm);

/// Largest strain of a block or film as its two bodies hold it in a state: of its bending (strain()), and its
/// edge_stretch_mm over its gap. 0 of a pin.
double hinge_strain(const MadeHinge& made, const Linkage& linkage, const State& state, int hinge);

/// A hinge that is strained by more than its material bears.
struct StrainedHinge {
  int hinge = 0;
  double strain = 0, borne = 0;  ///< dimensionless

  double share() const { return strain / borne; }
};

/// The one that is strained farthest beyond what its material bears in a state; nothing where all bear theirs.
/// @param made how a hinge is made; nullptr: not known, and left out
std::optional<StrainedHinge> most_strained(const Linkage& linkage, const State& state,
                                           const std::function<const MadeHinge*(int)>& made);

}  // namespace kinetix::model
