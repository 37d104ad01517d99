#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace kinetix::model {

/// A convex part of a body of any shape, about the body's rest position.
struct ContactPiece {
  int body = 0;
  std::vector<Eigen::Vector3d> corners;  ///< mm
  Eigen::MatrixX4d faces;                ///< a row each: unit normal outwards, and n . p on the face, mm
};

/// What bodies of a linkage press on each other with where these are no walls: convex pieces, which cover each body together.
struct ConvexBodies {
  std::vector<ContactPiece> pieces;  ///< those of one body one after the other
  std::vector<std::pair<int, int>>
      passing;  ///< pieces that pass through each other; sorted, lower ones first
};

}  // namespace kinetix::model
