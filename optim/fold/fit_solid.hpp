#pragma once

#include <string>
#include <vector>

#include "optim/fold/fit_fold.hpp"
#include "targets/fold/solid_net.hpp"

namespace kinetix::optim {

struct SolidDesign {
  targets::SolidNet
      net;  ///< with its tilts; where none folds, those of the last attempt at its largest theta
  std::vector<double> tilt;  ///< of each crease, rad
  double theta = 0;          ///< rad
  bool folds = false;        ///< within all limits, with no wall in the way
  bool stopped = false;      ///< before all was tried, with none that folds
  targets::FoldError error;  ///< of the closed form at theta
  std::vector<FoldAttempt> attempts;
  int evaluations = 0;  ///< motions that were checked for walls in the way
};

/// Fold lines of a crease: finer ones make nets wider, and are one more search.
inline constexpr int most_solid_columns = 4;

/// Searches as few columns a crease as will do, and theta, as large as walls allow, in steps of one degree: tilts follow
/// from it in closed form. A motion is free where walls stay `options.clearance` apart from flat to theta, looked at in
/// steps of one degree; faces that close a solid come near each other no faster than their walls turn.
/// @param cells of half a side of a face, >= 2   @param columns of each crease; 0: for the search to choose
/// @throws InvalidInput for options that do not validate and sizes that a net cannot have
SolidDesign fit_solid(const targets::Solid& solid, int cells, int columns, const FoldOptions& options,
                      const Progress& progress = {});

}  // namespace kinetix::optim
