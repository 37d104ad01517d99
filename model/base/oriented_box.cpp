#include "model/base/oriented_box.hpp"

#include <algorithm>
#include <cmath>

namespace kinetix {
namespace {

// Squared sine of the angle of two edges (1e-6 rad): below, their cross product is mostly rounding, and the
// face normals cover what it would tell.
constexpr double parallel_squared = 1e-12;

/// Projections of two boxes in the frame of the first.
struct Projections {
  Eigen::Matrix3d turn, size;  ///< axes of b by axes of a, and its absolute values
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

/// Distance of the centres along the cross product of edge i of a and edge j of b, times its length.
double edge_distance(const Projections& p, int i, int j) {
  const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
  return std::abs(p.offset[i2] * p.turn(i1, j) - p.offset[i1] * p.turn(i2, j));
}

/// Half extents of both boxes along it, likewise.
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

}  // namespace

bool overlap(const OrientedBox& a, const OrientedBox& b, double depth) {
  const Projections p(a, b);
  return !apart_along_faces(p, a, b, depth) && !apart_along_edges(p, a, b, depth);
}

double separation(const OrientedBox& a, const OrientedBox& b) {
  const Projections p(a, b);
  return std::max(gap_along_faces(p, a, b), gap_along_edges(p, a, b));
}

}  // namespace kinetix
