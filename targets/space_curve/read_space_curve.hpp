#pragma once

#include "targets/curve/read_points.hpp"
#include "targets/space_curve/space_goal.hpp"

namespace kinetix::targets {

/// Points of a goal in space: ten a column of the longest strip; nearest points are sought among all of them.
inline constexpr std::size_t max_space_points = 5000;

/// Every key of a `target:` section of kind space_curve.
const KeyTable& space_curve_target_keys();

/// A goal, and where its points stand in the file.
struct ReadSpaceGoal {
  SpaceGoal goal;
  std::vector<Place> places;  ///< of each point
};

/// The goal under a key (read_space_points).
/// @throws InvalidInput at the point at fault, in the CSV or in the document, as read_space_points, or for what
/// SpaceGoal refuses
ReadSpaceGoal read_space_goal(const Node& points);

}  // namespace kinetix::targets
