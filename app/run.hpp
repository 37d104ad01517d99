#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/design_file.hpp"
#include "app/larger_panels.hpp"
#include "app/plan.hpp"
#include "model/elastic/balance_comparison.hpp"
#include "model/elastic/stable_states.hpp"
#include "optim/fit_curve.hpp"
#include "optim/fit_display.hpp"
#include "optim/fit_fold.hpp"
#include "optim/fit_helmet.hpp"
#include "sim/compression_run.hpp"
#include "targets/display_goal.hpp"
#include "targets/head.hpp"

namespace kinetix {

/// A state with the name and the model that made it.
struct NamedState {
  std::string name;   ///< "target", or "frame" for the steps of a motion
  std::string model;  ///< "exact", "equilibrium" or "bullet"
  double theta = 0;   ///< rad
  State poses;
  HingeGaps gaps;
};

/// One row of a scene's speed-against-error table.
struct Fidelity {
  std::string model;
  double seconds = 0;  ///< for one state
  double error = 0;    ///< rms of body positions after rigid alignment, cell edges
  std::string against;
};

/// The physics run and its agreement with the model.
struct Verification {
  PhysicsOptions options;
  PhysicsResult physics;
  StateDistance distance;                    ///< NaN unless the run settled
  bool compared = false;                     ///< whether there was a model's state to compare with
  bool agrees = false;                       ///< settled and, if compared, distance.rms within the tolerance
  std::optional<BalanceComparison> balance;  ///< settled, and compared with a balance of elastic hinges
};

/// The balance of elastic hinges that a drive leads to.
struct Equilibrium {
  Elasticity elasticity;
  Drive drive;
  LoadPath path;
  StableStates stable;                      ///< that a release on the way leads to
  std::optional<StateDistance> from_exact;  ///< of the last state, where a closed form fits the drive so far

  bool reached() const { return path.stop == LoadPath::Stop::reached; }
};

struct Timings {
  double load = 0, plan = 0, optimise = 0, balance = 0, verify = 0, write = 0;  ///< seconds
  double larger_panels = 0;  ///< of searches that tell how large a display should be
};

/// What a curve search contributes to a result.
struct CurveOutcome {
  std::vector<Eigen::Vector2d> target_mm;  ///< as given
  CurveDesign found;
  SolverOptions solver;
  bool met = false;                     ///< shape within tolerance, and no walls in the way
  std::vector<std::string> why_missed;  ///< in words, empty where met
};

/// What a state of a panel shows.
struct DisplayReading {
  std::vector<double> channel;  ///< of each cell
  DisplayScore score;
  double rank = 0;  ///< rank correlation of channel and levels
};

/// What a search for a display contributes to a result.
struct DisplayOutcome {
  DisplayGoal goal;
  Channel channel = Channel::aperture;
  DisplayOptions options;
  DisplayDesign design;
  LargerPanels larger;                    ///< searched where this one is not clear enough
  DisplayReading before, after;           ///< flat, and the balance under the plates
  std::optional<DisplayReading> physics;  ///< the settled physics run
  std::vector<std::string> why_missed;    ///< in words, empty where the model shows what was asked
  std::vector<std::string> why_physics;   ///< likewise for the physics run

  bool met() const { return why_missed.empty(); }
  /// The smallest panel known to show the picture, where this one does not.
  std::optional<PanelSize> needed() const { return goal.whole ? larger.enough : goal.needed; }
};

/// What a search for a fold contributes to a result.
struct FoldOutcome {
  FoldGoal goal;
  FoldDesign design;
  std::optional<FoldError> physics;      ///< of the settled physics run
  std::vector<std::string> why_missed;   ///< in words, empty where the model folds as asked
  std::vector<std::string> why_physics;  ///< likewise for the physics run

  bool met() const { return why_missed.empty(); }
};

/// What a search for a helmet contributes to a result.
struct HelmetOutcome {
  Head head;
  HelmetWish wish;
  HelmetDesign design;                   ///< in the head's frame
  UniformHelmet uniform = {};            ///< the paper's way, for comparison
  std::optional<HelmetError> physics = {};  ///< the settled physics run, laid on the model's state
  std::vector<std::string> why_missed = {};   ///< in words, empty where the model is as asked
  std::vector<std::string> why_physics = {};  ///< likewise for the physics run

  bool met() const { return why_missed.empty(); }
};

/// Everything one call of the program knows at its end: what result.json and the report show.
struct Run {
  std::string name;
  std::uint64_t seed = 0;
  Structure structure;
  Plan plan;
  double theta = 0;  ///< rad, of the state shown
  std::optional<CurveOutcome> curve;
  std::optional<DisplayOutcome> display;
  std::optional<FoldOutcome> fold;
  std::optional<HelmetOutcome> helmet;
  std::vector<NamedState> states;
  PhysicsSection physics;  ///< these four as the file asked
  HingeSection hinge;
  std::optional<DriveSection> drive;
  int side = 1;
  std::optional<Equilibrium> equilibrium;
  std::optional<Verification> verification;
  std::vector<Fidelity> fidelity;
  double shape_tolerance = 0.01;
  double verify_tolerance = 0.02;
  Timings timings;
};

}  // namespace kinetix
