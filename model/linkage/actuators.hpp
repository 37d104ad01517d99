#pragma once

#include "model/linkage/linkage_drive.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Drives that act on hinges of any lattice: a tendon along several hinges, or a spring in each hinge.

/// Returns the point of a hinge midway between the positions carried by its two bodies, mm.
Eigen::Vector3d hinge_point(const Linkage& linkage, int hinge, const State& state);
/// Returns the length of a tendon from hinge point to hinge point, mm. @param through hinges, in the order of
/// the tendon
double cord_length(const Linkage& linkage, const std::vector<int>& through, const State& state);

/// Creates a drive that shortens a tendon through the points of hinges by `shorten_mm`.
/// @param branch 1 or -1, the sign of theta if the tendon pulls equally to either side.
/// @throws InvalidInput for fewer than two hinges, for a hinge twice in a row, and for a shortening that
/// leaves no tendon.
/// @throws InvalidInput if no two neighbouring points are on different bodies, which keeps the length constant
LinkageDrive cord_drive(const Linkage& linkage, const std::vector<int>& through, double shorten_mm,
                        int branch = 1);

/// Creates a drive by a spring in each of these hinges. At the end it rests at the hinge's turn_at_theta for
/// theta = angle / 2.
/// @param hinges empty: all   @param k_turn of each spring, N mm/rad   @param angle rad, in (-pi, pi)
/// @throws InvalidInput for numbers out of range, and for a hinge named twice
LinkageDrive shape_memory_drive(const Linkage& linkage, std::vector<int> hinges, double k_turn, double angle);

}  // namespace kinetix::model
