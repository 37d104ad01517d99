#pragma once

#include "model/contact/wall_contact.hpp"
#include "model/hinge/element.hpp"
#include "model/linkage/linkage.hpp"
#include "model/linkage/state.hpp"

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

/// Point of a piece that may enter other pieces.
struct SurfacePoint {
  Eigen::Vector3d at;  ///< in the body's frame, cell edges
  double weight = 1;   ///< of its energy: points on one edge or face share that of a corner
};

/// Contact surface of a convex piece, in its body's frame, cell edges. It has points that may enter other
/// pieces, and faces through which points of others are pushed out.
struct PieceSurface {
  int body = 0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< center of a ball that contains the piece
  double radius = 0;                                 ///< of that ball, cell edges
  std::vector<Eigen::Vector3d> corners;              ///< cell edges
  std::vector<SurfacePoint> points;                  ///< corners first, then along edges, then over faces
  Eigen::MatrixX4d faces;    ///< one per row, distinct: outward unit normal, and n . p on it, cell edges
  std::vector<char> pushes;  ///< whether a face is on the body's surface, not covered by its next piece

  /// Returns the largest n . p - offset over all faces: negative inside.
  double outside(const Eigen::Vector3d& p) const;
  /// Returns the nearest face on the body's surface to a point inside; -1 if no face is on the surface.
  int nearest_face(const Eigen::Vector3d& p) const;
  double gap(int face, const Eigen::Vector3d& p) const {
    return faces.row(face).head<3>().dot(p) - faces(face, 3);
  }
};

/// Computes the surfaces of all pieces. Points are a tenth of a cell edge apart, at most twelve along an
/// edge. Each edge and face has at least one.
std::vector<PieceSurface> piece_surfaces(const ConvexBodies& bodies, double edge_mm);

/// Point of one piece that is pressed into another one through a face.
struct PieceTouch {
  int piece = 0, point = 0;  ///< piece, and index of its point
  int other = 0,
      face = 0;      ///< the penetrated piece, and its nearest face on the body's surface
  double depth = 0;  ///< cell edges, > 0
};

/// Contact of bodies of any shape by their convex pieces. Points of each piece inside pieces of other bodies
/// have the energy 1/2 weight contact depth^2 per point. The points are corners, and others along edges and
/// over faces. The depth is measured to the nearest face on the other body's surface, and is linear in the
/// carried point, as in ContactModel. Energies are in units of k_point edge^2, stiffnesses of k_point. Edges
/// that cross between two points are not detected.
class PieceContact {
 public:
  PieceContact(const ConvexBodies& bodies, double edge_mm);

  /// Returns points in contact, in a fixed order. Empty for poses that are not finite.
  const std::vector<PieceTouch>& find(const State& state);

  /// Returns whether a point passed through a piece between two states, or entered through one face and would
  /// be pushed out through another. Then the step between them was too long for contact to stop it.
  /// @pre both states are finite
  bool passed_through(const State& before, const State& after);

  int body(int piece) const { return surfaces_[piece].body; }
  /// Returns the contact energy of a point. Body a is that of the point, b that of the face.
  Element element(const PieceTouch& touch, double stiffness, const State& state) const;
  double energy(const std::vector<PieceTouch>& touches, double stiffness) const;

 private:
  using PiecePair = std::pair<int, int>;

  /// Returns pairs whose bounding balls are closer than a margin. @param margins of each body, cell edges
  std::vector<PiecePair> pairs_within(const State& state, const std::vector<double>& margins);
  bool may_touch(const PiecePair& pair) const;
  /// Returns an upper bound of the displacement of each body's points, cell edges.
  std::vector<double> moved(const State& from, const State& to) const;
  bool has_left(const State& state) const;
  bool are_apart(int piece, int other, const State& state) const;
  void add_points_inside(int piece, int other, const State& state);
  bool went_through(int piece, int other, const State& before, const State& after) const;
  /// Returns the pose of a piece's body in the frame of the other piece's body, cell edges.
  Pose seen_from(int other, int piece, const State& state) const;

  double edge_mm_;
  std::vector<PieceSurface> surfaces_;
  std::vector<PiecePair> passing_;
  std::vector<double> reach_;    ///< of each body: the farthest of its corners from its origin, cell edges
  double largest_ = 0;           ///< radius of the largest piece, cell edges
  std::vector<PiecePair> near_;  ///< nearby pairs in near_state_
  State near_state_;
  std::vector<PieceTouch> found_;
  State found_state_;
  NearPairs finder_;
};

}  // namespace kinetix::model
