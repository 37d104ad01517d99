#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/compression_run.hpp"

namespace kinetix::sim {

/// What bodies of a linkage collide with where these are no walls: convex pieces of each, by their corners.
struct ContactParts {
  std::vector<std::vector<std::vector<Eigen::Vector3d>>>
      of_body;  ///< corners relative to the body's rest position, mm
};

/// Pieces of a body that are nearer to another body than this at rest, cell edges, pass through those of that one that are as near to it,
/// all the way: a rod and the bore in which it turns, ends of walls at a thin block, faces that lie on each other.
inline constexpr double touching_at_rest = 0.02;

/// run_compression, with bodies that collide by these pieces instead of walls. Each is 0.002 cell edges larger to all sides.
/// @pre as many bodies as the linkage has   @throws InvalidInput as run_compression, and for elastic hinges
PhysicsResult run_with_parts(const model::Linkage& structure, const model::LinkageDrive& drive,
                             const PhysicsOptions& options, const ContactParts& parts,
                             const PhysicsObserver& observer = {});

}  // namespace kinetix::sim
