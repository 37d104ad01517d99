#pragma once

#include <vector>

#include "model/contact/convex_bodies.hpp"

namespace kinetix::model {

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

}  // namespace kinetix::model
