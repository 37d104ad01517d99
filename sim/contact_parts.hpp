#pragma once

#include <Eigen/Core>
#include <compare>
#include <vector>

namespace kinetix::sim {

/// Collision shapes of a linkage's bodies in place of walls: convex pieces of each body, by their corners.
struct ContactParts {
  std::vector<std::vector<std::vector<Eigen::Vector3d>>>
      of_body;  ///< corners relative to the body's rest position, mm
};

/// Distance at rest, cell edges. Pieces of a body within this distance of another body pass through that
/// body's pieces within this distance, during the whole motion. Examples are a rod in its bore, ends of walls
/// at a thin block, and faces in contact.
inline constexpr double touching_at_rest = 0.02;

/// Two pieces of different bodies that pass through each other for that reason.
struct TouchingPieces {
  int body = 0, piece = 0;            ///< piece as ContactParts::of_body counts those of its body
  int other = 0, piece_of_other = 0;  ///< piece of the other body, other > body
  auto operator<=>(const TouchingPieces&) const = default;
};

}  // namespace kinetix::sim
