#pragma once

#include <functional>
#include <optional>

#include "model/linkage/state.hpp"
#include "model/matter/made_hinge.hpp"

namespace kinetix::model {

/// Returns the stretch of an elastomer or living hinge at its upper or lower edge, half its height from the
/// middle, in mm. The larger of the two counts, in tension or compression.
double edge_stretch_mm(const Linkage& linkage, const State& state, int hinge, double height_mm);

/// Returns the largest strain of an elastomer or living hinge in a state: that of its bending, strain(), plus
/// edge_stretch_mm() / gap. 0 for a pin.
double hinge_strain(const MadeHinge& made, const Linkage& linkage, const State& state, int hinge);

/// Hinge whose strain exceeds the limit of its material.
struct StrainedHinge {
  int hinge = 0;
  double strain = 0, borne = 0;  ///< dimensionless; borne: the limit of the material

  double share() const { return strain / borne; }
};

/// Returns the hinge with the largest ratio of strain to material limit, if any exceeds its limit.
/// @param made returns the dimensions of a hinge; nullptr: unknown, the hinge is skipped
std::optional<StrainedHinge> most_strained(const Linkage& linkage, const State& state,
                                           const std::function<const MadeHinge*(int)>& made);

}  // namespace kinetix::model
