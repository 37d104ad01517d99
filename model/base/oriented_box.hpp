#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinetix {

/// A box at any attitude, one end of which may be slanted. All lengths in one unit, the caller's: mm for half_walls(), cell
/// edges elsewhere.
struct OrientedBox {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: unit directions of its edges
  Eigen::Vector3d half =
      Eigen::Vector3d::Zero();  ///< half lengths along them, >= 0; of the first, halfway up the second
  double slant =
      0;  ///< by which its end to the positive side of the first axis is further out per length along the second
};

/// How far from its center a box reaches along a direction, times the length of that.
double support(const OrientedBox& box, const Eigen::Vector3d& direction);
/// Nothing of a box is further from its center.
double radius(const OrientedBox& box);
/// Unit normals of its faces, one of two that are parallel; and unit directions of its edges, likewise. Three, or four.
std::vector<Eigen::Vector3d> face_normals(const OrientedBox& box);
std::vector<Eigen::Vector3d> edge_directions(const OrientedBox& box);

/// Whether two boxes overlap by more than `depth` in every direction (a negative depth: come closer than
/// -depth), in the unit of the boxes. Separating-axis test over the 15 candidates, 24 of slanted ones: exact for depth 0. Cross
/// products of edges that are parallel to within 1e-6 rad are left out, as the face normals then cover them.
bool overlap(const OrientedBox& a, const OrientedBox& b, double depth = 0);

/// Largest gap of two boxes over the same directions: at most their distance, 0 where they overlap. In
/// the unit of the boxes.
double separation(const OrientedBox& a, const OrientedBox& b);

}  // namespace kinetix
