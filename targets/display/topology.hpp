#pragma once

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

}  // namespace kinetix::targets
