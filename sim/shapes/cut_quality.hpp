#pragma once

#include <Eigen/Geometry>

#include "model/solids/polyhedron.hpp"
#include "sim/shapes/convex_cuts.hpp"

namespace kinetix::sim {

/// Point off the surface, and the face below it.
struct WatchPoint {
  Eigen::Vector3d at;  ///< mm
  int triangle;
  double depth;  ///< share: its distance over that of the nearest ones: its weight
};

/// Returns the corners of triangle t, mm.
std::array<Eigen::Vector3d, 3> corners_of(const model::Polyhedron& solid, int t);

/// Distances of many places from one solid. The solid must outlive it.
class NearSolid {
 public:
  explicit NearSolid(const model::Polyhedron& solid);

  bool is_farther_than(const Eigen::Vector3d& p, double distance) const;
  /// Returns the index of the nearest triangle.
  int nearest(const Eigen::Vector3d& p) const;
  double distance(const Eigen::Vector3d& p) const;

  /// Checks by the winding number from solid angles (A. Van Oosterom and J. Strackee, IEEE Trans. Biomed.
  /// Eng. 30, 1983).
  bool holds(const Eigen::Vector3d& p) const;

 private:
  const model::Polyhedron& solid_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  std::vector<int> by_x_;  ///< triangles, sorted by the start of their boxes
};

/// Adds points over a triangle, at about this spacing in rows along its longest side, at least one.
void add_over(const std::array<Eigen::Vector3d, 3>& triangle, double spacing,
              std::vector<Eigen::Vector3d>& out);

/// Returns the watch points. A point at distance `off` from the nearest face is outside, since anything
/// between it and its face would be nearer.
std::vector<WatchPoint> watch_points(const model::Polyhedron& solid, const NearSolid& near, double off);

/// Quality of pieces, measured at points in an even sequence over their box.
struct CutQuality {
  double coverage = 0;       ///< share of the points inside the solid that are inside a piece
  double sticks_out_mm = 0;  ///< largest distance from the solid of a point inside a piece, mm
  double overlap = 0;        ///< share of the points in pieces that are in several
};
/// Measures the quality. @param points > 0, in the box
CutQuality measured(const std::vector<CutPiece>& pieces, const model::Polyhedron& solid, int points);

}  // namespace kinetix::sim
