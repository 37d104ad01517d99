#pragma once

#include <vector>

#include "targets/display/picture.hpp"

namespace kinetix::targets {

/// How a binary picture hangs together. Its Euler number is components - holes.
struct Topology {
  int components = 0;  ///< of ink; pixels that share an edge or a corner belong together
  int holes = 0;       ///< parts of the paper, joined over edges, that ink closes in
  bool operator==(const Topology&) const = default;
};

/// Of the pixels that are at least half ink.
Topology topology(const Picture& picture);

/// In two levels, 0 and 255, with parts of ink and then holes in it below an area turned over. @param area
/// pixels
Picture without_specks(const Picture& picture, double area);

/// Of the cells that are letter.
Topology topology(const DisplayGoal& goal);

/// What can be told apart of a picture by one value per cell: the topology of the cells above a level between the means of
/// letter and rest, that of the picture itself if any level gives it, else that of the middle level. Fewer parts or holes than
/// drawn: some melt into each other.
/// @param values in the order of DisplayGoal::levels, larger for the letter
Topology seen_topology(const DisplayGoal& goal, const std::vector<double>& values);

}  // namespace kinetix::targets
