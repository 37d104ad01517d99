#pragma once

#include "targets/drawing/drawing.hpp"

namespace kinetix::targets {

/// Two places of a planar graph that are near each other and not joined.
struct NearMiss {
  Eigen::Vector2d place, other;  ///< in the unit of the lines

  double gap() const { return (other - place).norm(); }
};

/// Planar graph of lines that may cross, overlap and end near each other.
struct JoinedLines {
  model::PlanarGraph graph;  ///< its edges meet at vertices only
  std::vector<int> line_of;  ///< for each edge the last of the lines that cover it
  double join = 0;           ///< distance in which places were joined, in the unit of the lines
};

/// Share of the median wall in which ends are joined by default. Half of the length of all walls is in walls that are at
/// least as long as the median wall.
inline constexpr double default_join = 2e-3;

/// Makes a planar graph of lines. Ends within `join` become one vertex. Lines are split where others end on them or
/// cross them, and lines that overlap are merged.
/// @param join in the unit of the lines, > 0; empty: the default share of the median wall, or less if lines are nearer
/// to each other.
/// @throws InvalidInput without a place for lines without length, and for more walls than a lattice may have
JoinedLines join_lines(const std::vector<DrawnLine>& lines, std::optional<double> join = {});

/// Finds places that are farther apart than the joining distance, and nearer than ten times as much. They are two
/// vertices without a wall between them, a vertex and a wall that does not end there, or the ends of a loose tail.
std::vector<NearMiss> find_near_misses(const JoinedLines& joined);

}  // namespace kinetix::targets
