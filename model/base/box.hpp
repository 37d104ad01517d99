#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace kinetix::model {

/// Computes the axis-aligned bounding box of points, a list of Eigen::Vector2d or Vector3d.
template <class Points>
auto box_of(const Points& points) {
  Eigen::AlignedBox<double, Points::value_type::RowsAtCompileTime> box;
  for (const auto& p : points) box.extend(p);
  return box;
}

}  // namespace kinetix::model

namespace kinetix {

/// A box in any orientation, with an optional slant of one end. All lengths are in one unit that the caller
/// chooses: mm for half_walls(), cell edges elsewhere.
struct OrientedBox {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: unit directions of its edges
  /// Half lengths along the axes, >= 0. The first one is measured halfway up the second axis.
  Eigen::Vector3d half = Eigen::Vector3d::Zero();
  double slant = 0;  ///< outward offset of the end at +axis 0, per length along axis 1
};

/// Returns how far the box extends from its center along a direction, times the length of that direction.
double support(const OrientedBox& box, const Eigen::Vector3d& direction);
/// Returns the radius of a ball about the center that contains the box.
double radius(const OrientedBox& box);
/// Returns the unit face normals, one per pair of parallel faces: three, or four for a slanted box.
/// Returns the unit directions of the edges: three, or four for a slanted box.
std::vector<Eigen::Vector3d> face_normals(const OrientedBox& box);
std::vector<Eigen::Vector3d> edge_directions(const OrientedBox& box);

/// Returns whether two boxes overlap by more than `depth` in every direction, in the unit of the boxes. A
/// negative depth tests whether they are closer than -depth. Separating-axis test over 15 candidate
/// directions, 24 for slanted boxes; exact for depth 0. Cross products of edges within 1e-6 rad of parallel
/// are left out, since the face normals cover them.
bool overlap(const OrientedBox& a, const OrientedBox& b, double depth = 0);

/// Returns the largest gap of two boxes over the directions of overlap(), in the unit of the boxes. It is a
/// lower bound of their distance, and 0 if they overlap.
double separation(const OrientedBox& a, const OrientedBox& b);

}  // namespace kinetix
