#pragma once

#include <unordered_map>

class btPersistentManifold;

namespace kinetix::sim {

using PointCounts = std::unordered_map<const void*, int>;

/// Where a wall tip edge presses along its height, the engine has two or more points: how many there are, by
/// point, for them to share the stiffness of one contact.
/// @pre the manifold is of two PartShapes
void count_points_on_edges(const btPersistentManifold& manifold, PointCounts& counts);

}  // namespace kinetix::sim
