#pragma once

#include <optional>

#include "model/assembly/cylinder_faces.hpp"

namespace kinetix::model {

/// At least six facets of a solid that are on one circular cone, over more than 200 degrees. Half angles are 5 to 80
/// degrees.
struct ConeFace {
  bool hollow = false;      ///< true: a cup; false: the outside of a tip
  Eigen::Vector3d apex;     ///< of the whole cone, mm
  Eigen::Vector3d axis;     ///< unit vector from the apex to the base
  double slope = 0;         ///< ratio of radius to height of the corners of its facets
  double inner_slope = 0;   ///< ratio of radius to height of the middle of its facets
  double from = 0, to = 0;  ///< range of axis . p, mm
};

/// At least three rings of facets of a solid that are on one ball.
struct BallFace {
  bool hollow = false;     ///< true: a socket or a dimple; false: the outside of a ball or a bump
  Eigen::Vector3d center;  ///< mm
  double radius_mm = 0;    ///< of the sphere through the corners of its facets, mm
  double inner_mm = 0;     ///< least distance of its facets from the center, mm
  double reach = 0;        ///< largest angle of its corners from its middle, rad: pi / 2 is a half ball
};

/// Returns the fit of a conical tip in a cup, as pin_fit. Their axes are parallel to 1 degree, their half angles equal to
/// 5 degrees. The rod's diameter is that of the tip in the middle of the overlap, the clearance normal to the cones.
std::optional<PinFit> cone_fit(const ConeFace& tip, const ConeFace& cup);

/// A ball of one body in the socket of another.
struct BallFit {
  Eigen::Vector3d center;    ///< mm
  double ball_mm = 0;        ///< diameter, mm
  double clearance_mm = 0;   ///< from the ball's corners to the socket's facets, mm
  bool is_retained = false;  ///< whether the socket goes so far round the ball that it cannot leave
};

/// Returns the fit of a ball in a socket. Their centers are nearer than the clearance, which is at most half the
/// ball's radius.
std::optional<BallFit> ball_fit(const BallFace& ball, const BallFace& socket);

/// Returns the pin that two balls in sockets make between two bodies: they turn about the line through the centers.
PinFit pin_of_balls(const BallFit& first, const BallFit& second);

/// Round faces of a body.
struct Bearings {
  std::vector<CylinderFace> cylinders;
  std::vector<ConeFace> cones;
  std::vector<BallFace> balls;
};
Bearings bearings_of(const Polyhedron& solid);

/// Hinges of two bodies by their shape.
struct BearingFits {
  std::vector<PinFit> pins;    ///< on separate axes
  std::vector<BallFit> balls;  ///< retained, and on none of these axes
};
/// Finds the pins and balls of two bodies. All bearings on one axis are one pin, and a rod with conical shoulders is as
/// long as the rod. Two balls are a pin. A ball that is not retained by its socket holds nothing.
BearingFits fits_between(const Bearings& first, const Bearings& second);

}  // namespace kinetix::model
