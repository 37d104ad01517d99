#pragma once

namespace kinetix::model {

/// Returns the degrees of freedom of a planar linkage with independent joints, by Eq. 1: 3 (N - 1 - j) + sum
/// of f. A panel has dependent joints: its count is below its true degrees of freedom.
/// @param bodies N >= 1   @param joints j >= 0   @param dofs sum of f >= 0, one for each hinge
/// @throws InvalidInput for an argument out of range
int gruebler_planar(int bodies, int joints, int dofs);

/// Returns the degrees of freedom of a spatial linkage with independent joints: 6 (N - 1 - j) + sum of f.
int gruebler_spatial(int bodies, int joints, int dofs);

}  // namespace kinetix::model
