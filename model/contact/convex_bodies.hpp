#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace kinetix::model {

/// A convex part of a body of any shape, relative to the body's rest position.
struct ContactPiece {
  int body = 0;
  std::vector<Eigen::Vector3d> corners;  ///< mm
  Eigen::MatrixX4d faces;                ///< a row per face: outward unit normal, and n . p on the face, mm
};

/// Contact shapes of the bodies of a linkage without walls: convex pieces that together cover each body.
struct ConvexBodies {
  std::vector<ContactPiece> pieces;  ///< the pieces of one body are contiguous
  std::vector<std::pair<int, int>>
      passing;  ///< pieces that pass through each other; sorted, lower ones first
};

}  // namespace kinetix::model
