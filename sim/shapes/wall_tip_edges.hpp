#pragma once

#include <unordered_map>

class btPersistentManifold;

namespace kinetix::sim {

using PointCounts = std::unordered_map<const void*, int>;

/// Counts the engine's points on each wall tip edge that presses along its height, by point. Two or more
/// points of an edge share the stiffness of one contact. @pre the manifold is of two PartShapes
void count_points_on_edges(const btPersistentManifold& manifold, PointCounts& counts);

}  // namespace kinetix::sim
