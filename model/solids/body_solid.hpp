#pragma once

#include "model/linkage/linkage.hpp"
#include "model/solids/hinge_shape.hpp"
#include "model/solids/polyhedron.hpp"

namespace kinetix::model {

/// A half wall with its end at the hinge, relative to the body's rest position, mm.
struct ArmSolid {
  int hinge = 0;
  bool fork = false;             ///< true: fork of a pin
  Eigen::Vector3d edge, up;      ///< unit vectors of the plate
  Eigen::Vector3d normal;        ///< unit vector, across the plate: n of HingeEnd
  Eigen::Vector3d towards_axis;  ///< unit vector: m of HingeEnd
  Eigen::Vector3d axis;          ///< unit vector: s of HingeEnd
  Eigen::Vector3d origin;        ///< origin of m, n and s, mm: on the plate's middle line
  double start = 0;              ///< position at which the plate leaves the junction, along the edge, mm
  CellSize size;
  HingeEnd end;

  /// Returns a point, mm. @param at (m, n), mm   @param s mm
  Eigen::Vector3d point(const Eigen::Vector2d& at, double s) const;
  /// Returns the corners at which the plate leaves the junction, mm: low and high n below, then above.
  std::vector<Eigen::Vector3d> start_corners() const;
};

/// A rigid body: a junction with its half walls. The junction is the convex hull of the sections at which they leave
/// it. Each section is as near to the vertex as possible, with no other section beyond it. Upright walls at right
/// angles give a post of their thickness; tilted walls give a wider one. Bodies therefore have no cracks, and all
/// faces except the junction's are known in advance.
struct BodySolid {
  std::vector<ArmSolid> arms;
  ConvexHull junction;
};

/// Function that returns the print of the hinge on each wall, by index.
using HingePrints = std::function<const HingePrint&(int hinge)>;

/// Creates all bodies of a linkage. The body of a pin that turns by +theta has the fork.
/// @throws InvalidInput, naming wall and vertex, if a hinge leaves no room for its wall's plate next to the junction
std::vector<BodySolid> body_solids(const Linkage& linkage, const HingePrints& hinges);

/// Returns the body's surface: one closed manifold.
Polyhedron body_mesh(const BodySolid& body);

/// A convex part of a body.
struct ConvexPiece {
  std::vector<Eigen::Vector3d> corners;  ///< relative to the body's rest position, mm
  int hinge = -1;                        ///< hinge of the piece; -1: none, for the junction
  bool is_rod = false;  ///< rod or a cone at its end: within an eye, which counts as if it had no bore
};

/// Returns pieces that together fill the body and the bores of its eyes, for the measurement of distances.
std::vector<ConvexPiece> convex_pieces(const BodySolid& body);

/// Returns the elastomer block or film of a hinge, at rest, relative to the lower body's rest position, mm. Its first
/// four corners touch the lower body's wall, its last four the upper body's.
Polyhedron soft_solid(const Linkage& linkage, int hinge, const HingePrint& print);

/// Returns the rod of a pin as a separate part, of the height of the pin, at rest, relative to the lower body's rest
/// position, mm.
Polyhedron rod_solid(const Linkage& linkage, int hinge, const HingePrint& print);

}  // namespace kinetix::model
