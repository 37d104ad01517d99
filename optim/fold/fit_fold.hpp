#pragma once

#include "model/base/progress.hpp"
#include "optim/fold/folded_net.hpp"
#include "optim/solvers/solver.hpp"
#include "targets/fold/fold_goal.hpp"
#include "targets/fold/solid_net.hpp"

namespace kinetix::optim {

struct FoldOptions {
  model::CellSize size = {};
  double tilt = 60 * radians_per_degree;  ///< largest tilt of a wall to either side, rad, (0, pi/2)
  AngleRange theta{2 * radians_per_degree, 44 * radians_per_degree};  ///< rad, in (0, pi/2), lower < upper
  double clearance = 0.02;    ///< least gap of walls that are not neighbours, cell edges, [0, 0.5)
  int threads = 0;            ///< >= 0; 0 = all cores. The result does not depend on it
  std::stop_token stop = {};  ///< on request, the search ends with its present result

  /// @throws InvalidInput naming field, value and rule
  void validate() const;
};

/// Result of one unfolding with one choice of columns.
struct FoldAttempt {
  int net = 0;               ///< index in the goal
  std::vector<int> columns;  ///< bending columns of each crease
  std::string why;           ///< reason for dropping it; empty if it folds
};

struct FoldDesign {
  FoldedNet folded;                    ///< if none folds, the first unfolding with its tilts cut off
  int net = 0;                         ///< index in the goal
  bool folds = false;                  ///< within all limits, with no wall or face in the way
  bool stopped = false;                ///< stopped early, before a net folded
  std::vector<FoldAttempt> attempts;   ///< in the order in which they were tried
  std::vector<std::string> obstacles;  ///< why none folds, each reason once; empty if one does
  int evaluations = 0;                 ///< motions that were checked for collisions
};

/// Searches the unfolding, the fewest bending columns per crease, and the largest theta that walls allow. The
/// larger theta, the smaller all tilts, which follow from it in closed form (fold_to). A motion is free if
/// walls do not collide from flat to beyond theta, checked in steps of one degree, and no face crosses
/// another (optim/fold/folded_net.hpp). If walls of one crease or of its two faces collide, more columns
/// are tried, up to a fold of 22.5 degrees per column. If faces collide, the next unfolding is tried.
/// @param progress share done, and the free range of the best unfolding so far
/// @throws InvalidInput for invalid options
FoldDesign fit_fold(const targets::FoldGoal& goal, const FoldOptions& options, const Progress& progress = {});

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
inline constexpr int max_solid_columns = 4;

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
