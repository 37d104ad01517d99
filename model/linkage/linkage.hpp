#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/base/geometry.hpp"

namespace kinetix::model {

/// A direction of the flat sheet.
enum class Axis { x, y };

/// Returns the unit vector of an axis.
inline Eigen::Vector3d edge_direction(Axis axis) {
  return axis == Axis::x ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
}

/// Returns the index of a vector's component along the axis: 0 or 1.
inline int component(Axis axis) { return axis == Axis::x ? 0 : 1; }

/// Returns the axis name in files and messages: "x" or "y".
inline const char* to_string(Axis axis) { return axis == Axis::x ? "x" : "y"; }

/// Sizes shared by all cells, mm.
struct CellSize {
  double edge_mm = 10.0;      ///< length of a wall in a square lattice: the unit "cell edge"
  double thickness_mm = 0.8;  ///< wall thickness, < edge_mm / 2
  double height_mm = 6.0;     ///< wall height, along z at rest
};

/// @throws InvalidInput naming the first length that is not above 0, or not finite
void check_lengths(const CellSize& size);

/// Four design parameters of the hinge on a wall along the edge e, from its lower body's vertex to its upper
/// body's vertex. The defaults are the basic planar hinge.
struct HingeParameters {
  double t = 0.5;         ///< fraction of the wall from the lower body's vertex, in (0, 1)
  double alpha = pi / 2;  ///< in-plane angle of the hinge axis from e, rad, in (0, pi)
  double beta = 0;        ///< out-of-plane tilt of the wall, rad, in (-pi/2, pi/2)
  double offset = 0;      ///< of the hinge point across the wall, in the direction z x e, cell edges
};

/// Derivatives by t (fraction), alpha (rad), beta (rad) and offset (cell edges) of one hinge.
using DesignGradient = Eigen::Vector4d;

/// A hinge in the rest frames of its two bodies; lengths are in cell edges.
struct RestHinge {
  int lower = 0, upper = 0;   ///< bodies
  Eigen::Vector3d edge;       ///< from the lower to the upper body's vertex; derivative of both arms by t
  Eigen::Vector3d across;     ///< unit, z x edge; derivative of both arms by the offset
  Eigen::Vector3d lower_arm;  ///< from the lower body's vertex to the hinge point
  Eigen::Vector3d upper_arm;
  Eigen::Vector3d axis;        ///< unit vector
  Eigen::Vector3d axis_alpha;  ///< derivative of the axis by alpha, per rad
  Eigen::Vector3d axis_beta;   ///< derivative of the axis by beta, per rad
  bool ball = false;           ///< holds only its point and turns in every direction; its axis is unused
};

/// Returns true if a hinge axis, a unit vector, is along z, to 1e-9 rad.
bool is_vertical(const Eigen::Vector3d& axis);
/// Returns true if the hinge's axis is along z at rest; false for a ball joint.
bool is_vertical(const RestHinge& hinge);

/// Part of a wall that belongs to one body, as a plate from the body's vertex to the wall's tip at the hinge.
/// It is tilted with the wall about its neutral axis. The frame is the body's rest frame, lengths are in cell
/// edges.
struct Plate {
  int body = 0;
  int hinge = 0;
  Eigen::Vector3d edge;     ///< unit, from the vertex to the tip
  Eigen::Vector3d up;       ///< unit, along the plate's height
  Eigen::Vector3d up_beta;  ///< derivative of `up` by the hinge's beta
  double length = 0;        ///< from the vertex to the tip
  double length_t = 1;      ///< derivative of `length` by the hinge's t
  /// Extra length of the tip cut along the hinge axis, ratio to the height: cot(alpha), signed
  double slant = 0;
};

/// A wall between the vertices of two bodies, flat at rest, and the hinge that divides it.
struct HingedWall {
  int lower = 0, upper = 0;  ///< bodies
  Eigen::Vector3d edge;  ///< from the lower body's vertex to the upper one's, in the plane z = 0, cell edges
  HingeParameters hinge;
};

/// Returns the up-direction w(beta) = cos(beta) z + sin(beta) (e x z) of a wall plate at rest, unit length.
/// @param edge in the plane z = 0, of any length but 0   @param beta rad
Eigen::Vector3d wall_up(const Eigen::Vector3d& edge, double beta);

/// Returns the hinge axis d = cos(alpha) e + sin(alpha) w(beta) at rest, unit length. @param edge as for
/// wall_up
Eigen::Vector3d hinge_axis(const Eigen::Vector3d& edge, const HingeParameters& parameters);

RestHinge rest_hinge(const HingedWall& wall);

/// Returns the lower body's plate, then the upper body's. @param index of the hinge in its linkage
std::array<Plate, 2> plates(const HingedWall& wall, int index);

/// A rigid body: the half walls that meet at one vertex.
struct LinkageBody {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< position of its vertex at rest, cell edges
  /// Direction of its turn about z, +1 or -1, as theta grows from flat. The two bodies of a hinge differ.
  int sense = 1;
  /// Turn as theta grows from flat, rad per rad. Empty: `sense` about z.
  std::optional<Eigen::Vector3d> spin = {};

  Eigen::Vector3d first_turn() const { return spin ? *spin : Eigen::Vector3d(0, 0, sense); }
};

/// A loop of bodies, each joined to the next by a hinge and the last to the first. Its length is even, since
/// neighbours have opposite senses.
struct LinkageCell {
  std::vector<int> bodies;  ///< counter-clockwise
  std::vector<int> hinges;  ///< hinge k joins bodies k and k + 1
};

/// Rigid bodies, the hinges that join them, and their walls, flat at rest. Elastic model, closure, contact
/// and simulation use only this description of a structure. Lattices create linkages (model/lattice/); a
/// linkage does not record its lattice.
struct Linkage {
  CellSize size;
  std::vector<LinkageBody> bodies;
  std::vector<RestHinge> hinges;
  std::vector<Plate> plates;  ///< two per hinge, at 2 hinge (the lower body's) and 2 hinge + 1
  std::vector<LinkageCell> cells;
  std::function<std::string(int hinge)> wall_name;   ///< wall name of a hinge in messages
  std::function<std::string(int body)> vertex_name;  ///< vertex name of a body in messages

  Eigen::Vector3d rest_position(int body) const;  ///< mm
};

/// Returns true if all hinge axes are along z at rest: then the structure moves in the plane.
bool all_vertical(const Linkage& linkage);

}  // namespace kinetix::model
