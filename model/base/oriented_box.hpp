#pragma once

#include <Eigen/Core>

namespace kinetix {

/// A box at any attitude. All lengths in one unit, the caller's: mm for half_walls(), cell edges elsewhere.
struct OrientedBox {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: unit directions of its edges
  Eigen::Vector3d half = Eigen::Vector3d::Zero();      ///< half lengths along them, >= 0
};

/// Whether two boxes overlap by more than `depth` in every direction (a negative depth: come closer than
/// -depth), in the unit of the boxes. Separating-axis test over the 15 candidates: exact for depth 0. Cross
/// products of edges that are parallel to within 1e-6 rad are left out, as the face normals then cover them.
bool overlap(const OrientedBox& a, const OrientedBox& b, double depth = 0);

/// Largest gap of two boxes over the same 15 directions: at most their distance, 0 where they overlap. In
/// the unit of the boxes.
double separation(const OrientedBox& a, const OrientedBox& b);

}  // namespace kinetix
