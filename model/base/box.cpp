#include "model/base/box.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace kinetix {
namespace {

// Squared sine of the angle between two edges (1e-6 rad). Below it their cross product is mostly rounding,
// and the face normals cover that direction.
constexpr double parallel_squared = 1e-12;
// Ratio of lengths. A smaller slant is rounding of a right angle, whose cotangent is not exactly 0.
constexpr double min_slant = 1e-12;

/// Projections of two boxes in the frame of the first one.
struct Projections {
  Eigen::Matrix3d turn, size;  ///< axes of b in the frame of a, and its absolute values
  Eigen::Vector3d offset;

  Projections(const OrientedBox& a, const OrientedBox& b)
      : turn(a.axes.transpose() * b.axes),
        size(turn.cwiseAbs()),
        offset(a.axes.transpose() * (b.center - a.center)) {}
};

bool apart_along_faces(const Projections& p, const OrientedBox& a, const OrientedBox& b, double depth) {
  for (int k = 0; k < 3; ++k) {
    if (std::abs(p.offset[k]) > a.half[k] + p.size.row(k).dot(b.half) - depth) return true;
    if (std::abs(p.offset.dot(p.turn.col(k))) > b.half[k] + p.size.col(k).dot(a.half) - depth) return true;
  }
  return false;
}

/// Returns the distance of the centres along n = (edge i of a) x (edge j of b), times |n|.
double edge_distance(const Projections& p, int i, int j) {
  const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
  return std::abs(p.offset[i2] * p.turn(i1, j) - p.offset[i1] * p.turn(i2, j));
}

/// Returns the sum of the half extents of both boxes along the same n, times |n|.
double edge_reach(const Projections& p, const OrientedBox& a, const OrientedBox& b, int i, int j) {
  const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
  return a.half[i1] * p.size(i2, j) + a.half[i2] * p.size(i1, j) + b.half[j1] * p.size(i, j2) +
         b.half[j2] * p.size(i, j1);
}

bool apart_along_edges(const Projections& p, const OrientedBox& a, const OrientedBox& b, double depth) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double squared = 1 - p.turn(i, j) * p.turn(i, j);
      if (squared < parallel_squared) continue;
      if (edge_distance(p, i, j) > edge_reach(p, a, b, i, j) - depth * std::sqrt(squared)) return true;
    }
  return false;
}

double gap_along_faces(const Projections& p, const OrientedBox& a, const OrientedBox& b) {
  double gap = 0;
  for (int k = 0; k < 3; ++k) {
    gap = std::max(gap, std::abs(p.offset[k]) - a.half[k] - p.size.row(k).dot(b.half));
    gap = std::max(gap, std::abs(p.offset.dot(p.turn.col(k))) - b.half[k] - p.size.col(k).dot(a.half));
  }
  return gap;
}

double gap_along_edges(const Projections& p, const OrientedBox& a, const OrientedBox& b) {
  double gap = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double squared = 1 - p.turn(i, j) * p.turn(i, j);
      if (squared < parallel_squared) continue;
      gap = std::max(gap, (edge_distance(p, i, j) - edge_reach(p, a, b, i, j)) / std::sqrt(squared));
    }
  return gap;
}

bool is_slanted(const OrientedBox& box) { return std::abs(box.slant) > min_slant; }

/// Unit vectors of a box: three, or four for a slanted box.
struct Directions {
  std::array<Eigen::Vector3d, 4> all;
  int count = 3;

  /// @param fourth extra direction of a slanted box, of any length but 0
  Directions(const OrientedBox& box, const Eigen::Vector3d& fourth)
      : all{box.axes.col(0), box.axes.col(1), box.axes.col(2)} {
    if (is_slanted(box)) all[count++] = fourth.normalized();
  }
  const Eigen::Vector3d* begin() const { return all.data(); }
  const Eigen::Vector3d* end() const { return all.data() + count; }
};

Directions normals_of(const OrientedBox& box) { return {box, box.axes.col(0) - box.slant * box.axes.col(1)}; }

Directions edges_of(const OrientedBox& box) { return {box, box.axes.col(1) + box.slant * box.axes.col(0)}; }

/// Returns the largest gap over all directions, or the first gap that is larger than `enough`.
double gap_of_slanted(const OrientedBox& a, const OrientedBox& b, double enough) {
  const Eigen::Vector3d apart = b.center - a.center;
  double gap = -std::numeric_limits<double>::infinity();
  const auto look = [&](Eigen::Vector3d direction) {
    if (direction.dot(apart) < 0) direction = -direction;
    gap = std::max(gap, direction.dot(apart) - support(a, direction) - support(b, -direction));
    return gap > enough;
  };
  for (const OrientedBox* box : {&a, &b})
    for (const Eigen::Vector3d& normal : normals_of(*box))
      if (look(normal)) return gap;
  const Directions others = edges_of(b);
  for (const Eigen::Vector3d& own : edges_of(a))
    for (const Eigen::Vector3d& other : others) {
      const Eigen::Vector3d across = own.cross(other);
      if (across.squaredNorm() >= parallel_squared && look(across.normalized())) return gap;
    }
  return gap;
}

}  // namespace

double support(const OrientedBox& box, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d along = box.axes.transpose() * direction;
  const double out = along[0] * box.half[0];
  return std::abs(along[2]) * box.half[2] +
         std::max(std::abs(along[1]) * box.half[1] - out,
                  std::abs(along[1] + box.slant * along[0]) * box.half[1] + out);
}

double radius(const OrientedBox& box) {
  return Eigen::Vector3d(box.half[0] + std::abs(box.slant) * box.half[1], box.half[1], box.half[2]).norm();
}

std::vector<Eigen::Vector3d> face_normals(const OrientedBox& box) {
  const Directions all = normals_of(box);
  return {all.begin(), all.end()};
}

std::vector<Eigen::Vector3d> edge_directions(const OrientedBox& box) {
  const Directions all = edges_of(box);
  return {all.begin(), all.end()};
}

bool overlap(const OrientedBox& a, const OrientedBox& b, double depth) {
  if (is_slanted(a) || is_slanted(b)) return !(gap_of_slanted(a, b, -depth) > -depth);
  const Projections p(a, b);
  return !apart_along_faces(p, a, b, depth) && !apart_along_edges(p, a, b, depth);
}

double separation(const OrientedBox& a, const OrientedBox& b) {
  if (is_slanted(a) || is_slanted(b))
    return std::max(0.0, gap_of_slanted(a, b, std::numeric_limits<double>::infinity()));
  const Projections p(a, b);
  return std::max(gap_along_faces(p, a, b), gap_along_edges(p, a, b));
}

}  // namespace kinetix
