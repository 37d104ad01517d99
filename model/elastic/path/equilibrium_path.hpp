#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "model/elastic/newton.hpp"
#include "model/hinge/elasticity.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::model {

struct EquilibriumPathOptions {
  std::optional<bool> planar;  ///< bodies move in the plane z = 0 only; default: if all hinges stand upright
  bool contact = true;         ///< walls of the structure's thickness press on each other
  std::shared_ptr<const ConvexBodies> bodies =
      {};        ///< with contact: what presses on each other in place of walls; null: the walls
  int side = 1;  ///< +1 or -1: to which side to leave a bifurcation that the drive's sign leaves open
  double first_step = 0.02;             ///< of theta, rad, (0, 0.5]
  double longest_step = 0.12;           ///< rad, (0, 0.5]
  double longest_step_touching = 0.02;  ///< rad, (0, 0.5], where walls touch; a jump to another state is
                                        ///< located to this, then taken and reported
  double least_step = 1e-3;             ///< rad, > 0
  double longest_jump = 0.1;  ///< rad a hinge turns beyond the prediction: more is a jump to another branch
  double gap_limit = 0.3;     ///< cell edges: the path ends where a hinge stretches more
  NewtonOptions newton;
  std::stop_token stop = {};  ///< where it asks to, the path ends with the last state that it came to

  /// @throws InvalidInput, naming the field, its value and its range
  void validate() const;
};

/// One state of an equilibrium path. Forces N or, for a driven hinge and springs, N mm; energies N mm.
struct EquilibriumStep {
  double theta =
      0;  ///< fold parameter of the drive, rad: of a cord and springs not always the sheet's (mean_theta)
  /// Compression of the plates, a fraction; turn of the driven hinge, rad; shortening of the cord, mm; turn at which springs
  /// rest, rad.
  double drive = 0;
  /// Energy by drive: positive where the structure resists. Force on the plates, tension of the cord, moment about the
  /// driven hinge, or the sum of the moments of all springs.
  double load = 0;
  double stiffness = NAN;  ///< rise of the load with the drive along the path, in their units; NaN: not known
  double energy = 0;       ///< of hinges, contacts and the drive's springs
  double springs = 0;      ///< of that, in the springs of a shape-memory drive
  double gap = 0;          ///< largest of a hinge, cell edges
  int contacts = 0;        ///< points in contact
  bool stable = true;

  /// What is left when the drive is gone, N mm: of hinges and contacts.
  double kept_energy() const { return energy - springs; }
};

/// Something a user should know of, and the load at which it happened.
struct PathEvent {
  enum class Kind {
    bifurcation,  ///< the equilibrium turned unstable, and a branch was chosen
    snap,  ///< it jumped to another state at (nearly) the same drive and lost energy: the way back is another
    limit_point,  ///< the load reached a maximum or a minimum
    contact,      ///< walls began to touch
    release,      ///< the last of them parted
    lock,         ///< walls carry the drive: the load rises steeply with it
    slack,        ///< a cord would have to push: it goes slack, and the structure goes on by itself
    departure,    ///< the path left the closed form that it came along, without turning unstable
  };
  Kind kind = Kind::bifurcation;
  /// The state at which it happened: of a jump to another branch the last one before it, else the first one behind it. Contact,
  /// release and jumps are located to 1.2e-7 rad of theta.
  EquilibriumStep at;
  double since = 0;  ///< theta of the last state before it, rad
  std::string what;
};

std::string to_string(PathEvent::Kind kind);

struct EquilibriumPath {
  enum class Stop {
    reached,        ///< the drive's goal
    overstretched,  ///< a hinge stretched by more than gap_limit
    locked,         ///< walls in contact, with which no further equilibrium was found
    not_converged,  ///< no equilibrium found, however small the step
    interrupted,    ///< it was told to stop
  };
  Stop stop = Stop::reached;
  std::string why;
  bool planar = false;
  State state;       ///< the last one in equilibrium, mm
  double theta = 0;  ///< rad, of that state
  HingeGaps gaps;
  std::vector<EquilibriumStep> steps;  ///< from flat on
  std::vector<PathEvent> events;
  std::vector<HingeEnergy> hinge_energies;  ///< N mm, of each hinge in the last state
  int iterations = 0;                       ///< of Newton's method in all
  double multiplier = 0;  ///< of the driven hinge, k_point edge^2, or the cord, k_point edge
  double off_closed_form_since =
      NAN;  ///< theta, rad, of the first state off the closed form that the path left; else NaN
  bool off_closed_form =
      false;  ///< there is one, and a hinge of the last state turns by over 0.1 rad otherwise, or that left it
  int let_go = 0;  ///< plates that press: bodies of their rows that they do not push at the goal
};

std::string to_string(EquilibriumPath::Stop stop);

/// Magnitude of the largest load on the way, N or N mm: what who drives the sheet has to bear. NaN where one is.
double largest_load(const EquilibriumPath& path);

/// Traces the equilibrium path of rigid bodies with elastic hinges from flat to the drive's goal, in adaptive
/// steps of theta, by prediction along the tangent and Newton's method. Weightless. Up to the last step, which ends at
/// the goal, states and events are those of a path to any goal that is further away. Where an equilibrium
/// turns unstable (flat under plates, for one) the path leaves it along the exact mode of a family where the
/// closed form is stable and has less energy, else along the lowest mode, to the side of the drive's sign
/// where that direction turns the checkerboard, else to `side`. A net between plates that grip a part of it
/// leans to one side from the first: it is taken to the closed form of the drive's sign as soon as that has
/// less energy. Plates that press let go at the goal of what they would have to pull (trace_pressed).
/// @param frame sees every state taken
/// @throws InvalidInput for options, stiffnesses or a drive out of range
EquilibriumPath trace_equilibrium(
    const DrivenLinkage& driven, const Elasticity& elasticity, const EquilibriumPathOptions& options = {},
    const std::function<void(const EquilibriumStep&, const State&)>& frame = {});

}  // namespace kinetix::model
