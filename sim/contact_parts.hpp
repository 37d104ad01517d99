#pragma once

#include <Eigen/Core>
#include <compare>
#include <vector>

namespace kinetix::sim {

/// What bodies of a linkage collide with where these are no walls: convex pieces of each, by their corners.
struct ContactParts {
  std::vector<std::vector<std::vector<Eigen::Vector3d>>>
      of_body;  ///< corners relative to the body's rest position, mm
};

/// Pieces of a body that are nearer to another body than this at rest, cell edges, pass through those of that one that are as near to it,
/// all the way: a rod and the bore in which it turns, ends of walls at a thin block, faces that lie on each other.
inline constexpr double touching_at_rest = 0.02;

/// Two pieces of different bodies that pass through each other for that reason.
struct TouchingPieces {
  int body = 0, piece = 0;            ///< piece as ContactParts::of_body counts those of its body
  int other = 0, piece_of_other = 0;  ///< likewise, other > body
  auto operator<=>(const TouchingPieces&) const = default;
};

}  // namespace kinetix::sim
