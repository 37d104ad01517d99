#pragma once

#include "model/linkage/linkage_drive.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Drives that hold on to hinges, of whatever lattice: a cord along some, a spring in each.

/// The point of a hinge half way between where its two bodies carry it, mm.
Eigen::Vector3d hinge_point(const Linkage& linkage, int hinge, const State& state);
/// From hinge point to hinge point, mm. @param through hinges, in the order of the cord
double cord_length(const Linkage& linkage, const std::vector<int>& through, const State& state);

/// A cord through the points of hinges, shortened by so much.
/// @param branch 1 or -1, the sign of theta where the cord pulls as well to either side
/// @throws InvalidInput for fewer than two hinges, one of them twice in a row, a shortening that leaves no cord, and for a
/// cord of which no two neighbouring points are on different bodies: rigid bodies keep it as long as it is
LinkageDrive cord_drive(const Linkage& linkage, const std::vector<int>& through, double shorten_mm,
                        int branch = 1);

/// A spring in each of these hinges that rests, in the end, where turn_at_theta has the hinge at theta = angle / 2.
/// @param hinges empty: all   @param k_turn of each spring, N mm/rad   @param angle rad, in (-pi, pi)
/// @throws InvalidInput for numbers out of range, and for a hinge named twice
LinkageDrive shape_memory_drive(const Linkage& linkage, std::vector<int> hinges, double k_turn, double angle);

}  // namespace kinetix::model
