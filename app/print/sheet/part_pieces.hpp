#pragma once

#include <memory>
#include <vector>

#include "app/print/sheet/print_sheet.hpp"

class btConvexHullShape;

namespace kinetix::app {

/// Points that go with one body, and a sphere round them, relative to the body's rest position, mm.
struct PieceEnd {
  int body = 0;
  Eigen::Matrix3Xd points;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0;
};

/// A convex piece of a part: of a body, or a block or film as the hull of its two ends.
struct PartPiece {
  int part = 0;
  std::vector<PieceEnd> ends;
  std::shared_ptr<btConvexHullShape> hull = {};  ///< of one end, with its support function
};

/// The parts of a sheet that may run into each other: its bodies, then blocks and films by hinge. Rods and cones of pins
/// are within eyes, which count as if they had no bore.
struct MovingParts {
  explicit MovingParts(const PrintSheet& sheet);

  int bodies = 0;
  std::vector<PartPiece> pieces;            ///< part by part
  std::vector<std::vector<int>> pieces_of;  ///< each part; empty of the soft part of a pin
  std::vector<PieceEnd> whole;              ///< of each body, all of its points
};

/// A piece where it is seen: a pose for each of its ends.
struct PlacedPiece {
  const PartPiece& piece;
  std::vector<const model::Pose*> poses;

  Eigen::Vector3d center() const;
};

/// The nearest points of two pieces; where they are in each other, the deepest.
struct PieceDistance {
  double mm = 0;                                    ///< mm, negative: how deep
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< mm, between them
  Eigen::Vector3d normal =
      Eigen::Vector3d::Zero();  ///< unit vector from the first to the second; 0: they touch
};
PieceDistance piece_distance(const PlacedPiece& a, const PlacedPiece& b);

}  // namespace kinetix::app
