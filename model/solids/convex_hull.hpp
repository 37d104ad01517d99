#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinetix::model {

/// Convex hull of few points, mm: its corners and its faces.
struct ConvexHull {
  std::vector<Eigen::Vector3d> corners;  ///< mm
  std::vector<std::vector<int>> faces;   ///< corners of each, counter-clockwise from outside
};

/// Computes the hull. Points nearer than 1e-7 mm are one corner, and points this near to a face's plane belong to it.
/// Faces are therefore polygons of any number of points. The method tries every plane through three points, in
/// O(n^4), and is meant for about 20 points.
/// @throws std::logic_error if the points are in one plane
ConvexHull convex_hull(const std::vector<Eigen::Vector3d>& points);

}  // namespace kinetix::model
