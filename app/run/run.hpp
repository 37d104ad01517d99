#pragma once

#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/run/found.hpp"
#include "app/run/run_options.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/elastic/equilibrium_comparison.hpp"
#include "model/elastic/path/stable_states.hpp"
#include "model/matter/process.hpp"
#include "model/tolerance/flat_starts.hpp"
#include "model/tolerance/print_runs.hpp"
#include "model/tolerance/touching_prints.hpp"
#include "sim/compression_run.hpp"

namespace kinetix::app {

/// A state with the name and the model that made it.
struct NamedState {
  std::string name;   ///< "target", or "frame" for the steps of a motion
  std::string model;  ///< "exact", "equilibrium" or "bullet"
  double theta = 0;   ///< rad
  model::State poses;
  model::HingeGaps gaps;
};

/// One row of a scene's speed-against-error table.
struct Fidelity {
  std::string model;
  double seconds = 0;  ///< of computing one state, s
  double error = 0;    ///< rms of body positions after rigid alignment, cell edges
  std::string against;
};

/// The physics run and its agreement with the model.
struct Verification {
  sim::PhysicsOptions options;
  sim::PhysicsResult physics;
  model::StateDistance distance;  ///< NaN unless the run settled
  bool compared = false;          ///< whether there was a model's state to compare with
  bool agrees = false;            ///< settled and, if compared, distance.rms within the tolerance
  bool coarse = false;            ///< in longer steps than usual, for which nobody asked
  std::optional<model::EquilibriumComparison>
      equilibrium;  ///< settled, and compared with an equilibrium of elastic hinges
};

/// The equilibrium of elastic hinges that a drive leads to.
struct Equilibrium {
  model::Elasticity elasticity;
  model::LinkageDrive drive;
  model::EquilibriumPath path;
  model::StableStates stable;  ///< that a release on the way leads to
  std::optional<model::StateDistance>
      from_exact;                         ///< of the last state, where a closed form fits the drive so far
  std::optional<double> turned_off = {};  ///< of a hinge of the last state from that closed form, most, rad

  bool reached() const { return path.stop == model::EquilibriumPath::Stop::reached; }
  /// Plates and cords push to no side of their own: the drive may be through while the sheet stands folded the other way.
  /// @param theta that it came to, rad
  bool is_on_the_other_side(double theta) const {
    constexpr double folded = 0.1;  // of the theta asked for: a sheet that is nearly flat is on no side
    const double asked = drive.theta();
    return reached() && asked * theta < 0 && std::abs(theta) > folded * std::abs(asked);
  }
};

/// What became of a goal that was met exactly once its hinges are elastic.
struct MatterResult {
  double exact_mm = 0;   ///< rms from the goal of the exact state
  double before_mm = 0;  ///< of the equilibrium of that design; NaN where none was found
  double after_mm = 0;   ///< of the design that makes up for it, which the run shows; NaN likewise
  double tolerance_mm = 0;
  double largest_change = 0;  ///< of a tilt, rad
  double theta_change = 0;    ///< rad
  int rounds = 0;             ///< steps that the search for it tried
  std::string why;            ///< it ended, or there is no equilibrium
};

/// What hinges are taken for that the file leaves open: soft blocks of the process, set at the turns of the design.
struct TakenHinges {
  model::MadeHinge made;
  double strain = 0;  ///< of the one that is strained most; ratio
  std::optional<double> load =
      {};                ///< that folds them to the design if nothing but their turns resists, N or N mm
  bool is_force = true;  ///< whether that is a force, N, of plates; else a moment, N mm, of the driven hinge

  std::string load_unit() const { return is_force ? "N" : "N mm"; }
};

/// What prints of a result come to.
struct PrintedGoal {
  model::AsMade made;
  std::optional<model::AsMade> without_play =
      {};                   ///< of pins: what the same prints would come to if they had none
  double tolerance_mm = 0;  ///< of the goal
  std::optional<model::PrintRuns> runs = {};  ///< that confirm it, or do not
  bool can_be_printed = true;                 ///< Run::print, or by the process where that was not asked
  /// Whether no walls meet on the way to the fold where each is as far out of place as the process leaves it, proven
  /// (ProvenRanges::printed), and no more prints touch than most_touching; nothing where nothing is proven of these states, as of
  /// equilibria of elastic hinges.
  std::optional<bool> free_of_contact = {};
  std::optional<TakenHinges> taken = {};
  /// Sample prints whose walls touch on the way to the fold; nothing where none could be looked at.
  std::optional<model::TouchingPrints> touching = {};
  /// Of elastic hinges between plates: sample prints pressed from flat; nothing where none were looked at.
  std::optional<model::FlatStarts> from_flat = {};

  /// Share of prints that may touch without a warning.
  static constexpr double most_touching = 0.05;
  bool touches_too_often() const { return touching && touching->share() > most_touching; }

  /// What prints are expected to be off, mm: to first order, times what the prints that were looked at are off over what first
  /// order has of the same prints, as far as these prints know that. Where the two are within 5 % of each other first order is
  /// as it is, and a ratio within its standard error of 1 corrects nothing.
  double rms_mm() const { return made.rms_mm * correction(); }
  double p95_mm() const { return made.p95_mm * correction(); }

  /// As expected, and in the prints that were looked at.
  bool holds() const {
    return can_be_printed && p95_mm() <= tolerance_mm &&
           (!runs || (runs->failed == 0 && runs->p95_mm <= tolerance_mm));
  }
  /// Whether first order comes near to the prints that were looked at; true where there are none.
  bool is_confirmed() const {
    constexpr double near = 0.3;   // of the rms
    constexpr double lost = 0.05;  // of the prints: those beyond what 95 of 100 keep
    return !runs || (runs->failed <= lost * (runs->prints + runs->failed) &&
                     std::abs(runs->rms_mm - runs->first_order_rms_mm) <= near * runs->first_order_rms_mm);
  }

 private:
  double correction() const {
    constexpr double near = 0.05;  // ratio
    if (!runs || !(runs->rms_mm > 0) || !(runs->first_order_rms_mm > 0)) return 1;
    const double more = runs->rms_mm / runs->first_order_rms_mm - 1;
    if (std::abs(more) <= near) return 1;
    const double noise = runs->ratio_error * runs->ratio_error / (more * more);
    return noise < 1 ? 1 + more * (1 - noise) : 1;
  }
};

/// How imported bodies went along their drive with all hinges closed.
struct ClosedWay {
  bool reached = false;  ///< its end
  model::State last;     ///< mm
  /// Of bodies that are pulled: distance of the last state from where they are pulled to, cell edges.
  std::optional<model::StateDistance> off = {};
  std::string words;                     ///< how far it goes, in a sentence
  std::vector<std::string> missed = {};  ///< why it does not come to what the drive asks for
};

struct Timings {
  double load = 0, plan = 0, optimise = 0, equilibrium = 0, matter = 0, as_made = 0, certify = 0,
         verify = 0;  ///< seconds
};

struct BodyPieces;

/// How far a sheet folds before walls meet, proven and not sampled.
struct ProvenRanges {
  model::ContactRange designed, printed;  ///< the latter of walls that are larger all round
};

/// Everything one call of the program knows at its end, what result.json and the report show: what was found, and what each
/// model says of it.
struct Run : Found {
  std::uint64_t seed = 0;
  std::vector<NamedState> states;
  std::optional<ClosedWay> way;              ///< of imported bodies
  std::shared_ptr<const BodyPieces> pieces;  ///< by which these collide; null where nothing asked for them
  std::optional<Equilibrium> equilibrium;
  std::optional<Verification> verification;
  std::optional<MatterResult> matter;  ///< of goals of exact families whose hinges are elastic
  /// Of a goal: how far the state is from it that its model holds it in, that of the equilibrium which takes its place where hinges
  /// are elastic, and that of the settled physics run; each where there is one.
  std::shared_ptr<const Measure> by_model, by_equilibrium, by_physics;
  std::vector<std::string> violations;  ///< why the goal is not met, in words
  bool strained = false;                ///< the one violation is of a hinge, by more than its material bears
  std::optional<PrintedGoal> printed;   ///< of goals that are judged by distances
  std::optional<PrintAnswer> print;     ///< of `export` to the design; nothing where it was not asked
  std::optional<ProvenRanges> certified;  ///< theta without contact; nothing where it was not asked for
  bool stopped = false;                   ///< the best so far, when it was told to stop
  std::string prints_unknown;  ///< why it is not known what prints of a goal come to; empty where it is
  std::vector<Fidelity> fidelity;
  Timings timings;

  bool met() const { return violations.empty(); }
  /// What the settled physics run lacks of the goal.
  std::vector<std::string> physics_violations() const {
    return by_physics ? by_physics->violations : std::vector<std::string>{};
  }
};

/// How far the state that results show is from the goal. @pre the run has been through its models
inline const Measure& shown_measure(const Run& run) {
  return run.by_equilibrium ? *run.by_equilibrium : *run.by_model;
}
template <class Kind>
const Kind& measure_of(const Run& run) {
  return dynamic_cast<const Kind&>(shown_measure(run));
}
/// That of the settled physics run; null where there is none.
template <class Kind>
const Kind* physics_measure_of(const Run& run) {
  return dynamic_cast<const Kind*>(run.by_physics.get());
}

/// Returns what the physics run is compared with, in words: "model", or "closed state" of imported bodies.
inline const char* model_words(const Run& run) { return run.way ? "closed state" : "model"; }

/// Returns the end of a line of the summary. @param is_within whether the value of the line keeps its tolerance
const char* tolerance_words(const Run& run, bool is_within);

/// Returns the design as design.yaml has it, with the requested theta.
Design written_design(const Run& run);

}  // namespace kinetix::app
