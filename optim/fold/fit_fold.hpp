#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "model/base/progress.hpp"
#include "optim/fold/folded_net.hpp"
#include "optim/solvers/variables.hpp"
#include "targets/fold/fold_goal.hpp"

namespace kinetix::optim {

struct FoldOptions {
  model::CellSize size = {};
  double tilt = 60 * radians_per_degree;  ///< most that a wall may tilt to either side, rad, (0, pi/2)
  AngleRange theta{2 * radians_per_degree, 44 * radians_per_degree};  ///< rad, in (0, pi/2), lower < upper
  double clearance = 0.02;    ///< least gap of walls that are no neighbours, cell edges, [0, 0.5)
  int threads = 0;            ///< >= 0; 0 = all cores. Their number changes no result
  std::stop_token stop = {};  ///< where it asks to, the search ends with what it has

  /// @throws InvalidInput naming field, value and rule
  void validate() const;
};

/// What became of one unfolding with one choice of columns.
struct FoldAttempt {
  int net = 0;               ///< in the goal
  std::vector<int> columns;  ///< bending columns of each crease
  std::string why;           ///< it was dropped; empty where it folds
};

struct FoldDesign {
  FoldedNet folded;                    ///< where none folds, the first unfolding with its tilts cut off
  int net = 0;                         ///< in the goal
  bool folds = false;                  ///< within all limits, with no wall and no face in the way
  bool stopped = false;                ///< before all was tried, with none that folds
  std::vector<FoldAttempt> attempts;   ///< in the order in which they were tried
  std::vector<std::string> obstacles;  ///< why none folds, each reason once; empty where one does
  int evaluations = 0;                 ///< motions that were checked for walls in the way
};

/// Searches the unfolding, as few bending columns a crease as will do, and theta, as large as walls allow:
/// the larger theta, the smaller all tilts, which follow from it in closed form (fold_to). A motion is free
/// where walls do not run into each other from flat to beyond theta, looked at in steps of one degree, and no
/// face crosses another on the way (optim/fold/face_crossing.hpp). Where walls of one crease or of the faces
/// beside it are in each other's way, more columns are tried, up to a fold of 22.5 degrees a column; where
/// faces are in the way, the next unfolding.
/// @param progress the share done, and how far the best unfolding so far is free
/// @throws InvalidInput for options that do not validate
FoldDesign fit_fold(const targets::FoldGoal& goal, const FoldOptions& options, const Progress& progress = {});

}  // namespace kinetix::optim
