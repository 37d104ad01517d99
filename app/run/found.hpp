#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/files/design_file.hpp"
#include "app/files/goal_settings.hpp"
#include "app/run/goal_outcome.hpp"
#include "app/run/plan.hpp"
#include "app/run/robust_choice.hpp"
#include "model/linkage/state.hpp"
#include "optim/matter/tilt_ties.hpp"
#include "optim/solvers/variables.hpp"

namespace kinetix::app {

/// What a file allows tilts and theta to be.
struct TurnBounds {
  double tilt = 75 * radians_per_degree;  ///< of either sign, rad, (0, pi/2)
  optim::AngleRange theta{2 * radians_per_degree, 44 * radians_per_degree};  ///< rad, (0, pi/2)
  /// Of a sheet that its search has found: which tilts it keeps alike, and within what.
  std::function<std::vector<optim::TiltTie>(const model::Lattice&)> ties = optim::tilt_ties;
};

/// What a goal asks of its physics run.
struct PhysicsWish {
  enum class When { always, if_met, never };
  When when = When::always;
  std::optional<model::LinkageDrive> drive = {};  ///< in place of the one that folds the sheet to theta
  double least_settle_s = 0;                      ///< simulated s that it has to come to rest
};

/// What a search found, or a design that was given.
struct Found {
  /// Its theta is that of `theta` below until it is written.
  Design design;
  double theta = 0;                         ///< rad, of the state shown
  std::shared_ptr<const GoalOutcome> goal;  ///< nothing for a design, which was not searched for
  Tolerances tolerances;                    ///< of a goal
  std::string judged_against = "the goal";  ///< what distances of points of the sheet are from, in words
  bool is_strip = false;                    ///< whether its columns alone say where something is in the sheet
  std::optional<model::ShapeMemory>
      goal_drive;                      ///< of goals of exact families: springs in place of the usual drive
  std::vector<HingePart> hinge_parts;  ///< of a goal's file
  /// Of a robust search, but of curves, which have columns to choose as well.
  std::optional<RobustChoice> robust;
  double verify_tolerance = GoalSettings::usual_verify;  ///< of Verification::distance.rms, cell edges

  /// Model that computes the states; nothing: exact where a family fits, else bullet.
  std::optional<Model> model = {};
  /// States on the way in which the model holds it, by theta, rad. Empty: those of the family.
  std::function<model::State(double theta)> motion = {};
  /// Where results show states of the model; nothing: where they are.
  std::optional<model::Pose> to_shown = {};
  /// Whether equilibria are shown as near to the model's state as a rigid motion takes them.
  bool is_laid_over = false;
  /// A state of its search: shown where the path to the equilibrium is stopped on its way.
  struct Known {
    Model model = Model::exact;
    model::State state;
  };
  std::optional<Known> known = {};
  PhysicsWish physics = {};
  std::vector<std::string> notes = {};  ///< sentences for the plan
  TurnBounds bounds = {};               ///< how far tilts and theta may go to make up for elastic hinges

  /// Set by planned(). A search that needs the exact motion sets that part of it.
  Plan plan;
  /// In which the model holds a goal's design, not yet where results show it. Set by planned(), of equilibria by their path.
  model::State own;
};

/// The design with the theta that was found or given.
Design asked_design(const Found& found);

/// What was found, with its plan, the hinges that the file makes otherwise, and its state where its family has a closed form.
/// @param brief RunOptions::brief
Found planned(Found found, bool brief = false);

inline void take_settings(Found& found, const GoalSettings& asked) {
  found.design.physics = asked.physics;
  found.design.hinge = asked.hinge;
  found.hinge_parts = asked.hinge_parts;
  found.goal_drive = asked.drive;
  found.design.process = asked.process;
  found.verify_tolerance = asked.verify_tolerance;
}

/// The outcome of a goal of the caller's own kind. @pre found.goal is one
template <class Outcome>
const Outcome& outcome_of(const Found& found) {
  return dynamic_cast<const Outcome&>(*found.goal);
}

/// Which state of a design is measured.
enum class StateOf { model, equilibrium, physics };

/// "model", "equilibrium" or "physics run": of elastic hinges that a goal of an exact family has, in the second case.
std::string in_words(StateOf of);

/// How far one state is from a goal; each kind of goal has its own.
class Measure {
 public:
  virtual ~Measure() = default;

  /// Reasons why the state misses the goal, in words; empty where it meets it.
  std::vector<std::string> violations = {};
  /// The same state where results show it; nothing: where it is.
  std::optional<model::State> shown = {};
  /// Sentences that a person should know and that leave the goal met.
  std::vector<std::string> warnings = {};
  /// Reason why prints of the state were not judged, where the kind judges prints itself.
  std::string prints_unknown = {};
};

}  // namespace kinetix::app
