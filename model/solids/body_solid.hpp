#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/linkage/linkage.hpp"
#include "model/solids/convex_hull.hpp"
#include "model/solids/hinge_shape.hpp"
#include "model/solids/polyhedron.hpp"

namespace kinetix::model {

/// A half wall with its end at the hinge, relative to the body's rest position, mm.
struct ArmSolid {
  int hinge = 0;
  bool fork = false;             ///< of a pin
  Eigen::Vector3d edge, up;      ///< unit vectors, of the plate
  Eigen::Vector3d normal;        ///< unit vector, across the plate: n of HingeEnd
  Eigen::Vector3d towards_axis;  ///< unit vector: m of HingeEnd
  Eigen::Vector3d axis;          ///< unit vector: s of HingeEnd
  Eigen::Vector3d origin;        ///< of m, n and s, mm: on the plate's middle line
  double start = 0;              ///< where the plate leaves the junction, along the edge, mm
  CellSize size;
  HingeEnd end;

  /// @param at (m, n), mm   @param s mm
  Eigen::Vector3d point(const Eigen::Vector2d& at, double s) const;
  /// Where the plate leaves the junction: low and high of n below, then above. mm
  std::vector<Eigen::Vector3d> start_corners() const;
};

/// A rigid body: a junction from which its half walls go out. The junction is the convex hull of the sections at
/// which they leave it, each as near to the vertex as no other reaches beyond it: of upright walls at right angles a
/// post as thick as they are, of tilted ones as wide as their tilt makes them. So bodies have no cracks, and all but the
/// junction's faces are known beforehand.
struct BodySolid {
  std::vector<ArmSolid> arms;
  ConvexHull junction;
};

/// What the hinge on each wall is, by its index.
using HingePrints = std::function<const HingePrint&(int hinge)>;

/// All bodies of a linkage. Of the two bodies of a pin the one that turns by +theta has the fork.
/// @throws InvalidInput, naming wall and vertex, where a hinge leaves no room for its wall's plate beside the junction
std::vector<BodySolid> body_solids(const Linkage& linkage, const HingePrints& hinges);

/// The body's surface: one closed manifold.
Polyhedron body_mesh(const BodySolid& body);

/// A convex part of a body.
struct ConvexPiece {
  std::vector<Eigen::Vector3d> corners;  ///< relative to the body's rest position, mm
  int hinge = -1;                        ///< that it is at; -1: none, of the junction
  bool is_rod = false;  ///< or a cone at its end: within an eye, which counts as if it had no bore
};

/// Pieces that fill the body together, and the bores of its eyes besides: what distances are measured between.
std::vector<ConvexPiece> convex_pieces(const BodySolid& body);

/// The block or film of a hinge, at rest, relative to the lower body's rest position, mm. Its first four corners touch the
/// lower body's wall, its last four the upper's.
Polyhedron soft_solid(const Linkage& linkage, int hinge, const HingePrint& print);

/// The rod of a pin as a part of its own, as long as the pin is high, at rest, relative to the lower body's rest
/// position, mm.
Polyhedron rod_solid(const Linkage& linkage, int hinge, const HingePrint& print);

}  // namespace kinetix::model
