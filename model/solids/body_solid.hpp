#pragma once

#include <array>
#include <map>
#include <optional>

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

/// Post on a body's junction, as wide as long, that a clip fits over. With a hole it is an eye for a strap. The hole
/// goes through along `angle`. It stands upright in the flat sheet.
struct Post {
  double angle = 0;      ///< of two of its sides' normals, from x, rad
  double half_mm = 0;    ///< half of its width
  double foot_mm = 0;    ///< height of its foot above all that the body else has, > 0
  double height_mm = 0;  ///< above the foot
  double hole_mm = 0;    ///< width of the hole; 0: none
  /// Heights at which upright sides of the hole begin and end, above the foot. A gable of 45 degrees ends the hole: it
  /// prints without supports.
  double hole_from_mm = 0, hole_to_mm = 0;
  double base_mm = 0;  ///< height of the foot's upper side above the body's origin; body_solids() sets it

  /// Returns the height of the gable's ridge above the foot, mm.
  double ridge_mm() const { return hole_to_mm + hole_mm / 2; }
  /// Returns a point of it, mm. @param along, across towards `angle` and a quarter turn further   @param up above the
  /// foot
  Eigen::Vector3d point(double along, double across, double up) const;
  /// Returns its corners at a height above the foot, counter-clockwise.
  std::array<Eigen::Vector3d, 4> corners(double up) const;
};

/// Posts by body.
using Posts = std::map<int, Post>;

/// A rigid body: a junction with its half walls. The junction is the convex hull of the sections at which they leave
/// it. Each section is as near to the vertex as possible, with no other section beyond it. Upright walls at right
/// angles give a post of their thickness; tilted walls give a wider one. Bodies therefore have no cracks, and all
/// faces except the junction's are known in advance.
struct BodySolid {
  std::vector<ArmSolid> arms;
  ConvexHull junction;  ///< with the foot of the post
  std::optional<Post> post = {};
};

/// Function that returns the print of the hinge on each wall, by index.
using HingePrints = std::function<const HingePrint&(int hinge)>;

/// Creates all bodies of a linkage. The body of a pin that turns by +theta has the fork. Junctions with a post are
/// wide enough for its foot.
/// @throws InvalidInput, naming wall and vertex, if a hinge leaves no room for its wall's plate next to the junction
std::vector<BodySolid> body_solids(const Linkage& linkage, const HingePrints& hinges,
                                   const Posts& posts = {});

/// Returns the body's surface: one closed manifold.
Polyhedron body_mesh(const BodySolid& body);

/// A convex part of a body.
struct ConvexPiece {
  std::vector<Eigen::Vector3d> corners;  ///< relative to the body's rest position, mm
  int hinge = -1;                        ///< hinge of the piece; -1: none, for junction and post
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
