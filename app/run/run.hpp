#pragma once

#include "app/run/run_options.hpp"
#include "app/run/search_result.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/elastic/equilibrium_comparison.hpp"
#include "model/elastic/path/stable_states.hpp"
#include "model/material/process.hpp"
#include "model/tolerance/print_runs.hpp"
#include "model/tolerance/touching_prints.hpp"
#include "sim/physics_run.hpp"

namespace kinetix::app {

/// State with its name and the model that computed it.
struct NamedState {
  std::string name;   ///< "target", or "frame" for the steps of a motion
  std::string model;  ///< "exact", "equilibrium" or "bullet"
  double theta = 0;   ///< rad
  model::State poses;
  model::HingeGaps gaps;
};

/// Row of a scene's speed-against-error table.
struct Fidelity {
  std::string model;
  double seconds = 0;  ///< time of one state, s
  double error = 0;    ///< rms of body positions after rigid alignment, cell edges
  std::string against;
};

/// Simulation and its agreement with the model.
struct Verification {
  sim::PhysicsOptions options;
  sim::PhysicsResult physics;
  model::StateDistance distance;  ///< NaN unless the run settled
  bool compared = false;          ///< whether the model had a state to compare with
  bool agrees = false;            ///< settled and, if compared, distance.rms within the tolerance
  bool coarse = false;            ///< whether steps are longer than usual, without a request
  std::optional<model::EquilibriumComparison>
      equilibrium;  ///< if settled and compared with an equilibrium of elastic hinges
};

/// Equilibrium of elastic hinges that a drive leads to.
struct Equilibrium {
  model::Elasticity elasticity;
  model::LinkageDrive drive;
  model::EquilibriumPath path;
  model::StableStates stable;                      ///< states that a release on the path leads to
  std::optional<model::StateDistance> from_exact;  ///< of the last state, if a closed form fits the drive
  std::optional<double> turn_difference =
      {};  ///< largest difference of a hinge turn from that closed form, rad

  bool reached() const { return path.stop == model::EquilibriumPath::Stop::reached; }
  /// Whether the drive is complete with the sheet folded to the opposite side. Plates and tendons do not select
  /// a branch.
  /// @param theta that the sheet reached, rad
  bool is_on_the_other_side(double theta) const {
    constexpr double folded = 0.1;  // ratio to the requested theta: a sheet that is nearly flat is on no side
    const double asked = drive.theta();
    return reached() && asked * theta < 0 && std::abs(theta) > folded * std::abs(asked);
  }
};

/// Compensation of a goal that was met exactly, for its elastic hinges.
struct CompensationResult {
  double exact_mm = 0;   ///< rms error of the exact state
  double before_mm = 0;  ///< rms error of that design's equilibrium; NaN if none was found
  double after_mm = 0;   ///< rms error of the compensated design, which the run shows; NaN if none was found
  double tolerance_mm = 0;
  double largest_change = 0;  ///< largest change of a tilt, rad
  double theta_change = 0;    ///< rad
  int rounds = 0;             ///< steps that the compensation tried
  std::string why;            ///< why the compensation ended, or why there is no equilibrium
};

/// Soft hinges of prints whose design is computed with joints, at rest at the turns of the design. Sizes are of the one
/// that is strained most for its material.
struct SoftHinges {
  model::ManufacturedHinge made;
  bool is_assumed = false;  ///< whether no hinge that could be printed is known
  double strain = 0;        ///< of that hinge, ratio
};

/// Print tolerance of a result.
struct PrintedGoal {
  model::ToleranceResult made;
  std::optional<model::ToleranceResult> without_clearance =
      {};                                     ///< of pins: the same prints without clearance
  double tolerance_mm = 0;                    ///< of the goal
  std::optional<model::PrintRuns> runs = {};  ///< sample prints that confirm it or not
  bool can_be_printed = true;                 ///< whether it is printable: Run::print, else by the process.
  /// Whether prints are free of contact during the motion to the fold. It is proven for walls as far out of place as
  /// the process leaves them (ProvenRanges::printed). In addition, at most the share most_touching of sample prints
  /// touches. Empty if nothing is proven of these states, such as equilibria of elastic hinges.
  std::optional<bool> free_of_contact = {};
  std::optional<SoftHinges> soft = {};
  /// Sample prints whose walls touch during the motion to the fold; empty if none could be checked.
  std::optional<model::TouchingPrints> touching = {};
  /// Sample prints pressed from flat, for elastic hinges between plates; empty if none were checked.
  std::optional<model::FlatStarts> from_flat = {};

  /// Share of prints that may touch without a warning.
  static constexpr double most_touching = 0.05;
  bool touches_too_often() const { return touching && touching->share() > most_touching; }

  /// Returns the expected error of prints, mm: first order times a correction. The correction is the ratio of the
  /// error of the sample prints to their first-order error, weighted by how well these prints determine it. There is
  /// none for a ratio within 5 % of 1, or within its standard error of 1.
  double rms_mm() const { return made.rms_mm * correction(); }
  double p95_mm() const { return made.p95_mm * correction(); }

  /// Whether prints keep the tolerance, both as expected and in the sample prints.
  bool holds() const {
    return can_be_printed && p95_mm() <= tolerance_mm &&
           (!runs || (runs->failed == 0 && runs->p95_mm <= tolerance_mm));
  }
  /// Whether first order is near the sample prints; true if there are none.
  bool is_confirmed() const {
    constexpr double near = 0.3;   // ratio to the rms of first order
    constexpr double lost = 0.05;  // fraction of prints: those beyond what 95 of 100 keep
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

/// Motion of imported bodies along their drive with all hinges closed.
struct ClosedPath {
  bool reached = false;  ///< whether they reached its end
  model::State last;     ///< mm
  /// Distance of the last state from where bodies are pulled to, cell edges; empty if a hinge is turned.
  std::optional<model::StateDistance> off = {};
  std::string description;               ///< one sentence on how far the bodies moved
  std::vector<std::string> missed = {};  ///< why the motion misses the goal of the drive
};

struct Timings {
  double load = 0, plan = 0, optimise = 0, equilibrium = 0, compensation = 0, print_tolerance = 0,
         certify = 0,
         verify = 0;  ///< seconds
};

struct BodyPieces;

/// Collision-free ranges of theta, by a continuous collision check and not by samples.
struct ProvenRanges {
  model::ContactRange designed, printed;  ///< `printed`: for walls that are larger all round
};

/// Results of one call of the program, as in result.json and the report: what was found, and the results of each
/// model.
struct Run : SearchResult {
  std::uint64_t seed = 0;
  std::vector<NamedState> states;
  std::optional<ClosedPath> closed_path;     ///< of imported bodies
  std::shared_ptr<const BodyPieces> pieces;  ///< by which these collide; null if not requested
  std::optional<Equilibrium> equilibrium;
  std::optional<Verification> verification;
  std::optional<CompensationResult> compensation;  ///< of goals of exact families whose hinges are elastic

  /// Distances from a goal: of the model's state, of the equilibrium that replaces it if hinges are elastic, and of
  /// the settled simulation. Null if there is no such state.
  std::shared_ptr<const Measure> by_model, by_equilibrium, by_physics;
  std::vector<std::string> violations;    ///< why the goal is not met, in words
  bool strained = false;                  ///< whether the one violation is the strain of a hinge
  std::optional<PrintedGoal> printed;     ///< of goals that are judged by distances
  std::optional<ProvenRanges> certified;  ///< theta without contact; empty if not requested
  bool stopped = false;                   ///< whether it is the best so far, after a stop request
  std::string prints_unknown;             ///< why the print tolerance of a goal is not known; empty if it is
  std::vector<Fidelity> fidelity;
  Timings timings;

  bool met() const { return violations.empty(); }
  /// Returns the violations of the goal by the settled simulation.
  std::vector<std::string> physics_violations() const {
    return by_physics ? by_physics->violations : std::vector<std::string>{};
  }
};

/// Returns how far the state that results show is from the goal. @pre the run has been through its models
inline const Measure& shown_measure(const Run& run) {
  return run.by_equilibrium ? *run.by_equilibrium : *run.by_model;
}
template <class Kind>
const Kind& measure_of(const Run& run) {
  return dynamic_cast<const Kind&>(shown_measure(run));
}
/// Returns the measure of the settled simulation; null if there is none.
template <class Kind>
const Kind* physics_measure_of(const Run& run) {
  return dynamic_cast<const Kind*>(run.by_physics.get());
}

/// Returns what the simulation is compared with, in words: "model", or "closed state" of imported bodies.
inline const char* reference_name(const Run& run) { return run.closed_path ? "closed state" : "model"; }

/// Returns the design as design.yaml has it, with the requested theta.
Design written_design(const Run& run);

/// Returns the names of the two walls of a pair of plates. A wall has two plates, one at each side of its hinge.
std::array<std::string, 2> wall_names(const model::WallPair& walls, const model::Lattice& sheet);

/// Returns "walls A and B overlap as built" with advice.
std::string describe_overlap(const model::WallPair& walls, const model::Lattice& sheet);

/// Returns "walls A and B overlap at theta 25.126 deg, on the way to 28.000 deg". @param theta end of the motion, rad
/// @pre limit.contact
std::string describe_overlap(const model::ContactLimit& limit, double theta, const model::Lattice& sheet);

/// Describes why walls keep an exact motion from reaching the run's theta, one sentence. They overlap as built or
/// during the motion, by the certified range if there is one, otherwise by samples. Empty if no contact is known.
std::optional<std::string> contact_reason(const Run& run);

/// Returns contact_reason() with advice, as a list of at most one entry. @param instead advice, in words
std::vector<std::string> collisions_during_motion(const Run& run, const std::string& instead);

/// Describes how a path stopped, for people. result.json has `torn` for an overstretched hinge.
std::string describe(model::EquilibriumPath::Stop stop);

/// Describes that a sheet folded to the opposite side. @param theta that it reached, rad
std::string describe_other_side(const Equilibrium& equilibrium, double theta);

/// Describes why an equilibrium is not the goal of its drive. @param theta that it reached, rad
/// @pre its path stopped early, or the sheet is on the opposite side
std::string describe_missed_drive(const Equilibrium& equilibrium, double theta);

/// Describes where and why the drive stops before its goal, one sentence. @pre it did
std::string drive_stop_reason(const model::EquilibriumPath& path);

}  // namespace kinetix::app
