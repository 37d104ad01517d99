#pragma once

#include <functional>
#include <string>

#include "model/linkage/state.hpp"

namespace kinetix::testing {

/// The two parts of a folding sheet that are deepest in each other.
struct Crossing {
  double mm =
      0;  ///< how deep: the largest distance to the other's surface of points of one that are in it; 0: none are
  std::string first, second;  ///< by the names of the file
  int step = -1;              ///< at which; -1: none
  int parts = 0;              ///< of the file
  int tests = 0;              ///< pairs that were measured, of all steps
};

/// Folds what a glTF file holds: each body's mesh as it is, with the poses of a state, and each block with its two bodies, by
/// FCL's distances of triangle meshes. Knows nothing of kinetix's solids, convex pieces and bounds of motion. A pair is left
/// alone for as many steps as its two parts need at least, at the largest step of each, to close the distance that was measured.
/// The two bodies of a block do not count against it.
/// @param steps from 0 on   @param state one pose a body, in the file's order, mm   @param enough_mm at which it stops looking
Crossing fold_and_compare(const std::string& glb, int steps, const std::function<model::State(int)>& state,
                          double enough_mm);

}  // namespace kinetix::testing
