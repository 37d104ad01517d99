#pragma once

#include <vector>

#include "model/contact/convex_bodies.hpp"

namespace kinetix::model {

/// A point of a piece that may run into other pieces.
struct SurfacePoint {
  Eigen::Vector3d at;  ///< in the body's frame, cell edges
  double weight = 1;   ///< of its energy: those along an edge or over a face share that of one corner
};

/// A convex piece as contact sees it, in its body's frame, cell edges: points that run into others, and faces through which those
/// of others are pushed out.
struct PieceSurface {
  int body = 0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< of a ball that holds it
  double radius = 0;                                 ///< of that ball, cell edges
  std::vector<Eigen::Vector3d> corners;              ///< cell edges
  std::vector<SurfacePoint> points;                  ///< corners first, then along edges, then over faces
  Eigen::MatrixX4d faces;    ///< a row each, no two alike: unit normal outwards, and n . p on it, cell edges
  std::vector<char> pushes;  ///< whether a face lies on the body's surface: none where its next piece goes on

  /// Largest n . p - offset over all faces: below 0 inside.
  double outside(const Eigen::Vector3d& p) const;
  /// Of a point inside: the face of the surface that is nearest; -1 where no face is one.
  int nearest_face(const Eigen::Vector3d& p) const;
  double gap(int face, const Eigen::Vector3d& p) const {
    return faces.row(face).head<3>().dot(p) - faces(face, 3);
  }
};

/// Points stand a tenth of a cell edge apart, up to twelve along an edge, at least one on an edge and over a face.
std::vector<PieceSurface> piece_surfaces(const ConvexBodies& bodies, double edge_mm);

}  // namespace kinetix::model
