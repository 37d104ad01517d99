#pragma once

#include <Eigen/Core>

#include "model/linkage/state.hpp"
#include "model/sheet/sheet.hpp"

namespace kinetix::app {

/// What a state looks like, in numbers. Lengths in mm, angles in rad; NaN in the state gives NaN, and so do cells where there are none.

/// From the first body (lowest column, then row) to the last.
Eigen::Vector3d end_point(const model::Sheet& structure, const model::State& state);

/// Turn of the midline (mean of the bodies of each column, seen along y) from its first segment to its last,
/// added up from column to column: more than a full turn counts as such.
double total_turn(const model::Sheet& structure, const model::State& state);

/// Area between the four bodies of each cell, over that at rest.
double area_ratio(const model::Sheet& structure, const model::State& state);

/// Angle between the planes of the first and the last cell, [0, pi].
double fold_angle(const model::Sheet& structure, const model::State& state);

/// Angle at the first vertex of the first cell between its bottom and left sides, [0, pi].
double cell_angle(const model::Sheet& structure, const model::State& state);

/// Largest angle between the z directions of two bodies that share a hinge: the twist or fold across a wall.
double largest_lean(const model::Sheet& structure, const model::State& state);

/// Edges of the bounding box of the bodies' positions, along the structure's axes; of the surfaces of imported bodies.
Eigen::Vector3d extent(const model::Sheet& structure, const model::State& state);

}  // namespace kinetix::app
