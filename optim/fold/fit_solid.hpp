#pragma once

#include <string>
#include <vector>

#include "optim/fold/fit_fold.hpp"
#include "targets/fold/solid_net.hpp"

namespace kinetix::optim {

struct SolidDesign {
  targets::SolidNet net;  ///< with its tilts; if none folds, those of the last attempt at its largest theta
  std::vector<double> tilt;  ///< of each crease, rad
  double theta = 0;          ///< rad
  bool folds = false;        ///< within all limits, without colliding walls
  bool stopped = false;      ///< stopped early, before a net folded
  targets::FoldError error;  ///< of the closed form at theta
  std::vector<FoldAttempt> attempts;
  int evaluations = 0;  ///< motions that were checked for collisions
};

/// Most fold lines of a crease: more widen the nets and need one more search.
inline constexpr int most_solid_columns = 4;

/// Searches the fewest columns per crease, and the largest theta that walls allow, in steps of one degree.
/// The tilts follow from theta in closed form. A motion is free if walls stay `options.clearance` apart from
/// flat to theta, checked in steps of one degree. Faces that close a solid approach each other no faster than
/// their walls turn.
/// @param cells number along half a side of a face, >= 2.
/// @param columns of each crease; 0: chosen by the search.
/// @throws InvalidInput for invalid options and sizes that a net cannot have
SolidDesign fit_solid(const targets::Solid& solid, int cells, int columns, const FoldOptions& options,
                      const Progress& progress = {});

}  // namespace kinetix::optim
