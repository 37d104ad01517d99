#pragma once

#include <stop_token>

#include "model/elastic/newton.hpp"
#include "model/hinge/elasticity.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::model {

struct EquilibriumPathOptions {
  std::optional<bool> planar;  ///< bodies move in the plane z = 0 only; default: if all hinges are vertical
  bool contact = true;         ///< walls of the structure's thickness touch each other
  /// With contact: bodies that touch instead of walls; null: the walls.
  std::shared_ptr<const ConvexBodies> bodies = {};
  int side = 1;                ///< +1 or -1: side of a bifurcation if the drive's sign does not select one
  double first_step = 0.02;    ///< of theta, rad, (0, 0.5]
  double longest_step = 0.12;  ///< rad, (0, 0.5]
  /// Longest step while walls touch, rad, (0, 0.5]. A jump to another state is first narrowed down to a step
  /// of this length, then taken and reported.
  double longest_step_touching = 0.02;
  double min_step = 1e-3;     ///< rad, > 0
  double longest_jump = 0.1;  ///< rad a hinge turns beyond the prediction; more is a jump to another branch
  double gap_limit = 0.3;     ///< cell edges: the path ends if a hinge opens more
  NewtonOptions newton;
  std::stop_token stop = {};  ///< on request, the path ends at the last state reached

  /// @throws InvalidInput, naming the field, its value and its range
  void validate() const;
};

/// State of an equilibrium path. Loads are in N, or N mm for a driven hinge and springs; energies in N mm.
struct EquilibriumStep {
  /// Fold parameter of the drive, rad. For a tendon and springs it may differ from the sheet's mean_theta().
  double theta = 0;
  /// Compression of the plates, a fraction; turn of the driven hinge, rad; shortening of the tendon, mm; or
  /// rest turn of the springs, rad.
  double drive = 0;
  /// Derivative of the energy by `drive`; positive if the structure resists. Force on the plates, tension of
  /// the tendon, moment about the driven hinge, or the sum of the moments of all springs.
  double load = 0;
  double stiffness = NAN;  ///< of load by drive along the path, in their units; NaN: unknown
  double energy = 0;       ///< of hinges, contacts and the drive's springs
  double springs = 0;      ///< of that, in the springs of a shape-memory drive
  double gap = 0;          ///< largest of all hinges, cell edges
  int contacts = 0;        ///< points in contact
  bool stable = true;

  /// Returns the energy that is left without the drive, N mm: that of hinges and contacts.
  double kept_energy() const { return energy - springs; }
};

/// Event on a path that the user should know of, with the state at which it happened.
struct PathEvent {
  enum class Kind {
    bifurcation,  ///< the equilibrium turned unstable, and a branch was chosen
    snap,  ///< snap-through to another state at (nearly) the same drive, with loss of energy: not reversible
    limit_point,  ///< the load reached a maximum or a minimum
    contact,      ///< walls began to touch
    release,      ///< the last of them parted
    lock,         ///< jamming: walls transmit the drive's load, which rises steeply
    slack,        ///< a tendon would have to push: it goes slack, and the structure continues without it
    departure,    ///< branching: the path left its closed form without instability
  };
  Kind kind = Kind::bifurcation;
  /// State of the event. For a jump to another branch it is the last state before it, otherwise the first one
  /// after it. Contact, release and jumps are located to 1.2e-7 rad of theta.
  EquilibriumStep at;
  double since = 0;  ///< theta of the last state before it, rad
  std::string what;
};

std::string to_string(PathEvent::Kind kind);

struct EquilibriumPath {
  enum class Stop {
    reached,        ///< the drive's goal
    overstretched,  ///< a hinge stretched by more than gap_limit
    locked,         ///< walls in contact, and no further equilibrium was found
    not_converged,  ///< no equilibrium found, even with the shortest step
    interrupted,    ///< stopped on request
  };
  Stop stop = Stop::reached;
  std::string why;
  bool planar = false;
  State state;       ///< the last one in equilibrium, mm
  double theta = 0;  ///< rad, of that state
  HingeGaps gaps;
  std::vector<EquilibriumStep> steps;  ///< starting with flat
  std::vector<PathEvent> events;
  std::vector<HingeEnergy> hinge_energies;  ///< N mm, of each hinge in the last state
  int iterations = 0;                       ///< total of Newton's method
  double multiplier = 0;  ///< for the driven hinge, k_point edge^2, or the tendon, k_point edge
  /// Theta, rad, of the first state off the closed form that the path left; otherwise NaN.
  double off_closed_form_since = NAN;
  /// Whether the path left its closed form, or a hinge of the last state differs from it by more than 0.1
  /// rad.
  bool off_closed_form = false;
  int let_go = 0;  ///< plates that press: number of row bodies without contact force at the goal
};

std::string to_string(EquilibriumPath::Stop stop);

/// Returns the largest load magnitude on the path, N or N mm, which the actuator must supply. NaN if a load
/// is NaN.
double largest_load(const EquilibriumPath& path);

/// Traces the equilibrium path of rigid bodies with elastic hinges from flat to the drive's goal. Steps of
/// theta are adaptive; each is predicted along the tangent and corrected by Newton's method. Gravity is
/// neglected. Except for the last step, which ends at the goal, states and events do not depend on the goal.
///
/// If an equilibrium turns unstable, such as flat under plates, the path leaves it along one of two modes.
/// The exact mode of a family is taken if the closed form is stable and has less energy, otherwise the lowest
/// mode. The side is that of the drive's sign if the mode turns the checkerboard, otherwise `side`.
///
/// A sheet between plates that grip only part of it leans to one side from the start. The path moves to the
/// closed form of the drive's sign as soon as that has less energy. Plates that press release at the goal the
/// bodies that they would have to pull (trace_pressed()).
/// @param frame called with every accepted state
/// @throws InvalidInput for options, stiffnesses or a drive out of range
/// @throws InvalidInput for options, stiffnesses or a drive out of range
EquilibriumPath trace_equilibrium(
    const DrivenLinkage& driven, const Elasticity& elasticity, const EquilibriumPathOptions& options = {},
    const std::function<void(const EquilibriumStep&, const State&)>& frame = {});

}  // namespace kinetix::model
