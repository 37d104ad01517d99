#pragma once

#include <functional>
#include <string>

#include "model/linkage/state.hpp"

namespace kinetix::testing {

/// The deepest penetration of two parts of a folding sheet.
struct Crossing {
  double mm =
      0;  ///< largest distance of a point inside the other part from its surface; 0: no point is inside
  std::string first, second;  ///< names in the file
  int step = -1;              ///< step of the penetration; -1: none
  int parts = 0;              ///< parts in the file
  int tests = 0;              ///< pairs that were measured, over all steps
};

/// Folds the meshes of a glTF file: each body with the poses of a state, and each block with its two bodies. FCL
/// computes the distances of the triangle meshes.
/// The solids, convex pieces and motion bounds of kinetix are not used. A pair is skipped while its parts
/// have moved relative to each other by less than their measured distance. A block is not tested against its own two
/// bodies.
/// @param steps number of states, counted from 0
/// @param state returns one pose per body, in the file's order, mm
/// @param enough_mm depth at which the search stops
Crossing fold_and_compare(const std::string& glb, int steps, const std::function<model::State(int)>& state,
                          double enough_mm);

}  // namespace kinetix::testing
