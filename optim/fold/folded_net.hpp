#pragma once

#include <vector>

#include "model/lattice/square/family/net.hpp"
#include "targets/fold/fold_error.hpp"

namespace kinetix::optim {

/// A net with the hinges that fold it, and its error.
struct FoldedNet {
  targets::FoldNet net;
  targets::NetLayout layout;
  model::Structure structure;
  model::NetTree tree;       ///< of the structure, from the middle of the first face
  std::vector<double> tilt;  ///< of each crease, rad, >= 0: size of the tilt of all its walls
  double theta = 0;          ///< rad
  targets::FoldError error;  ///< of the closed form at theta
};

/// Returns the net with each crease's fold spread evenly over its columns. Tilts follow from tan(fold / 2k) =
/// tan(tilt) sin(theta) and are cut off at `most_tilt`.
/// @param columns k of each crease, >= 1   @param theta rad, (0, pi / 2)   @param most_tilt rad, (0, pi / 2)
/// @throws InvalidInput for columns with which the net overlaps itself
FoldedNet fold_to(const targets::FoldNet& net, const std::vector<int>& columns, double theta,
                  const model::CellSize& size, double most_tilt);

/// Returns the part of the net of each body: its face, or the number of faces plus the index of the crease
/// with the body between its columns.
std::vector<int> parts_of_bodies(const FoldedNet& folded);

/// "face `lid`" or "crease `base-lid`"
std::string part_name(const targets::FoldNet& net, int part);

}  // namespace kinetix::optim
