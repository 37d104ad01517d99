#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinetix::model {

/// The convex hull of few points, mm: its corners and its faces.
struct ConvexHull {
  std::vector<Eigen::Vector3d> corners;  ///< mm
  std::vector<std::vector<int>> faces;   ///< corners of each, counter-clockwise from outside
};

/// Points nearer than 1e-7 mm are one corner, and points that near to a face's plane belong to it: so faces are
/// polygons, however many points lie in them. Every plane through three points is tried, which takes n^4 steps and is
/// meant for some 20 points. @throws std::logic_error where the points lie in one plane
ConvexHull convex_hull(const std::vector<Eigen::Vector3d>& points);

}  // namespace kinetix::model
