#pragma once

#include <vector>

#include "model/lattice/square/family/net.hpp"
#include "targets/fold/fold_error.hpp"

namespace kinetix::optim {

/// A net with the hinges that fold it, and how well it folds.
struct FoldedNet {
  targets::FoldNet net;
  targets::NetLayout layout;
  model::Structure structure;
  model::NetTree tree;       ///< of the structure, from the middle of the first face
  std::vector<double> tilt;  ///< of each crease, rad, >= 0: every wall of it tilts as much
  double theta = 0;          ///< rad
  targets::FoldError error;  ///< of the closed form at theta
};

/// The net with each crease's fold spread evenly over its columns: tilts by tan(fold / 2k) = tan(tilt)
/// sin(theta), cut off at `most_tilt`.
/// @param columns k of each crease, >= 1   @param theta rad, (0, pi / 2)   @param most_tilt rad, (0, pi / 2)
/// @throws InvalidInput for columns with which the net overlaps itself
FoldedNet fold_to(const targets::FoldNet& net, const std::vector<int>& columns, double theta,
                  const model::CellSize& size, double most_tilt);

/// The part of the net that each body belongs to: its face, or the number of faces plus the index of the
/// crease whose columns have the body between them.
std::vector<int> parts_of_bodies(const FoldedNet& folded);

/// "face `lid`" or "crease `base-lid`"
std::string part_name(const targets::FoldNet& net, int part);

}  // namespace kinetix::optim
