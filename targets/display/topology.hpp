#pragma once

#include <vector>

#include "targets/display/picture.hpp"

namespace kinetix::targets {

/// Connectivity of a binary picture. Its Euler number is components - holes.
struct Topology {
  int components = 0;  ///< of ink; pixels that share an edge or a corner belong together
  int holes = 0;       ///< parts of the paper, joined over edges, that ink encloses
  bool operator==(const Topology&) const = default;
};

/// Computes the topology of the pixels that are at least half ink.
Topology topology(const Picture& picture);

/// Returns the picture in two levels, 0 and 255, without specks: inverts parts of ink, then holes in it, below an
/// area. @param area pixels
Picture without_specks(const Picture& picture, double area);

/// Computes the topology of the letter cells.
Topology topology(const DisplayGoal& goal);

/// Computes the topology that one value per cell can show. Cells above a level between the means of letter and rest
/// count as letter. If any level gives the topology of the goal, the result is that; otherwise it is that of the
/// middle level. Fewer parts or holes than drawn mean that some have merged.
/// @param values in the order of DisplayGoal::levels, larger for the letter
Topology seen_topology(const DisplayGoal& goal, const std::vector<double>& values);

}  // namespace kinetix::targets
