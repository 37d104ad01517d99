#pragma once

#include "app/files/design_file.hpp"
#include "app/files/goal_settings.hpp"
#include "app/run/goal_outcome.hpp"
#include "app/run/plan.hpp"
#include "app/run/run_options.hpp"
#include "model/linkage/state.hpp"
#include "optim/elastic/tilt_ties.hpp"
#include "optim/solvers/solver.hpp"

namespace kinetix::app {

/// Returns the cost that a robust search minimises, mm. @param weight of prints, (0, 1]; the design itself has the
/// rest to 1
inline double robust_cost(double weight, double designed_mm, double printed_mm) {
  return (1 - weight) * designed_mm + weight * printed_mm;
}

/// Whether a search prefers a candidate (designed_mm, printed_mm, is_allowed) to the best so far.
template <class Candidate>
bool is_more_robust(double weight, const Candidate& next, const Candidate& best) {
  const auto cost = [&](const Candidate& c) { return robust_cost(weight, c.designed_mm, c.printed_mm); };
  return next.is_allowed && (!best.is_allowed || cost(next) < cost(best));
}

/// Design tried by a robust search, with the expected error of its prints.
struct RobustCandidate {
  double theta = 0;  ///< rad
  double cell_mm = 0;
  std::optional<double> gap_mm = {};  ///< of blocks and films
  double designed_mm = 0;             ///< rms error of the design itself; NaN if not known
  double printed_mm = 0;              ///< expected rms error of prints; NaN if not known
  double printed_p95_mm = 0;          ///< mm, error that 95 of 100 prints stay within; NaN if not known

  /// Whether it meets the goal, also in the equilibrium of its hinges, can be printed, and its hinges withstand the
  /// strain.
  bool is_allowed = false;
  std::string why_not = {};  ///< reason in words if it is not allowed
};

/// Designs from which a robust search chose.
struct RobustChoice {
  std::vector<RobustCandidate> tried;  ///< the plain search's design first
  std::size_t chosen = 0;              ///< index in tried
};

/// Bounds of tilts and theta by a file.
struct TurnBounds {
  double tilt = 75 * radians_per_degree;  ///< largest tilt of either sign, rad, (0, pi/2)
  optim::AngleRange theta{2 * radians_per_degree, 44 * radians_per_degree};  ///< rad, (0, pi/2)
  /// Returns which tilts of a found sheet stay equal, each with its range.
  std::function<std::vector<optim::TiltTie>(const model::Lattice&)> ties = optim::tilt_ties;
};

/// Folding of a sheet with its own hinges, by the drive of least force.
struct Folding {
  std::string name;  ///< of the drive, such as "plates normal to y"; empty: no drive folds it
  std::optional<model::Drive> drive = {};  ///< as in a design; empty: no single push folds it
  double load = 0;                         ///< largest on the path: N, of a turned hinge N mm; 0 of springs
  bool is_force = true;                    ///< whether `load` is in N
  bool is_unaided = false;                 ///< whether springs in the hinges fold it
  bool turns_freely = false;               ///< whether all hinges are pins: `load` is that of their friction
  std::string why_not = {};                ///< why no drive folds it, one sentence
  std::string overstrain = {};  ///< names a hinge strained beyond the limit of its material in that fold

  bool is_possible() const { return why_not.empty(); }
  /// Returns true if pins are turned one after the other, since each push takes the sheet to another fold.
  bool is_by_turns() const { return turns_freely && !drive; }
};

/// Returns how a sheet is folded, as in result.json: "by hand" up to 100 N or 3 N m, "with a clamp" up to 1000 N or
/// 30 N m, "unaided" by springs in the hinges, else "no".
std::string describe_effort(const Folding& folding);

/// Simulation that a goal requests.
struct PhysicsRequest {
  enum class When { always, if_met, never };
  When when = When::always;
  std::optional<model::LinkageDrive> drive = {};  ///< replaces the drive that folds the sheet to theta
  double min_settle_s = 0;                        ///< least simulated time for settling, s
};

/// Result of a search, or a design that was given.
struct SearchResult {
  /// Its theta is replaced by `theta` below when it is written.
  Design design;
  double theta = 0;                         ///< rad, of the state shown
  std::shared_ptr<const GoalOutcome> goal;  ///< null for a design, which was not searched for
  Tolerances tolerances;                    ///< of a goal
  std::string compared_with = "the goal";   ///< what points of the sheet are compared with, in words
  bool is_strip = false;                    ///< whether a column is enough to locate a place in the sheet
  std::optional<model::ShapeMemory>
      goal_drive;                      ///< springs in place of the usual drive, for goals of exact families
  std::vector<HingePart> hinge_parts;  ///< from a goal's file
  /// Choice of a robust search. Empty for curves, whose choice includes columns.
  std::optional<RobustChoice> robust;
  double verify_tolerance =
      GoalSettings::default_verify_tolerance;  ///< limit of Verification::distance.rms, cell edges

  /// Model that computes the states. Empty: exact if a family fits, otherwise bullet.
  std::optional<Model> model = {};
  /// States of the motion by the model, by theta, rad. Empty: those of the family.
  std::function<model::State(double theta)> motion = {};
  /// Pose to which results move states of the model. Empty: they stay where they are.
  std::optional<model::Pose> to_shown = {};
  /// Whether results show equilibria after rigid alignment with the model's state.
  bool is_aligned = false;
  /// State of the search, shown if the path to the equilibrium is stopped early.
  struct Known {
    Model model = Model::exact;
    model::State state;
  };
  std::optional<Known> known = {};
  PhysicsRequest physics = {};
  /// Answer of `export` to a goal's design; empty if not requested, or if its hinges are settled by equilibrium.
  std::optional<PrintAnswer> print = {};
  /// Folding by the hinges of the design; empty if it is not known.
  std::optional<Folding> folding = {};
  std::vector<std::string> notes = {};  ///< sentences for the plan
  TurnBounds bounds = {};               ///< bounds of tilts and theta in the compensation for elastic hinges

  /// Plan, set by planned(). A search that needs the exact motion sets that part itself.
  Plan plan;
  /// State of a goal's design by its model, not yet moved by to_shown. Set by planned(), for equilibria by their
  /// path.
  model::State own;
};

/// Returns the design with the theta that was found or given.
Design requested_design(const SearchResult& found);

/// Adds the plan and the per-hinge overrides of the file to what was found. Adds its state if its family has a closed
/// form.
/// @param brief RunOptions::brief   @throws InvalidInput if the state of a goal needs a closed form that is missing
SearchResult planned(SearchResult found, bool brief = false);

inline void copy_settings(SearchResult& found, const GoalSettings& asked) {
  found.design.physics = asked.physics;
  found.design.hinge = asked.hinge;
  found.hinge_parts = asked.hinge_parts;
  found.goal_drive = asked.drive;
  found.design.process = asked.process;
  found.design.lock = asked.lock;
  found.verify_tolerance = asked.verify_tolerance;
  found.notes.insert(found.notes.end(), asked.input_notes.begin(), asked.input_notes.end());
}

/// Returns the outcome of a goal as the caller's type. @pre found.goal has that type
template <class Outcome>
const Outcome& outcome_of(const SearchResult& found) {
  return dynamic_cast<const Outcome&>(*found.goal);
}

/// State of a design that is measured.
enum class StateOf { model, equilibrium, physics };

/// Returns "model", "equilibrium" or "simulation". The second is that of elastic hinges of a goal of an exact
/// family.
std::string describe(StateOf of);

/// Distance of one state from a goal; each kind of goal has its own.
class Measure {
 public:
  virtual ~Measure() = default;

  /// Reasons why the state misses the goal, in words; empty if it meets the goal.
  std::vector<std::string> violations = {};
  /// Distance from the goal, ratio to its tolerance; NaN if the kind has no remedies (Goal::remedies).
  double distance = std::numeric_limits<double>::quiet_NaN();
  /// Measured state as results show it; empty: where it is.
  std::optional<model::State> shown = {};
  /// Warnings that leave the goal met.
  std::vector<std::string> warnings = {};
  /// Reason why prints of the state were not judged, if the kind judges prints itself.
  std::string prints_unknown = {};
};

}  // namespace kinetix::app
