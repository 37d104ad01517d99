#pragma once

#include <memory>

class btConstraintSolver;
class btDiscreteDynamicsWorld;

namespace kinetix::sim {

class Cord;
class ElasticHinges;
class Hand;

struct DirectSolverSettings {
  double joint_stiffness = 1e4;  ///< as PhysicsOptions has it, over the parts' masses
  double grip = 100;             ///< how many times stiffer than a hinge a joint to the ground is
  double contact_softness = 10;  ///< how many times softer than a hinge a contact is: with elastic hinges
                                 ///< all points of a wall tip edge together, else every point
  double edge_mm = 1;            ///< cell edge of the structure of `elastic`, `cord` and `hand`
  const ElasticHinges* elastic = nullptr;  ///< null for none; must outlive the solver
  const Cord* cord = nullptr;              ///< likewise
  const Hand* hand = nullptr;              ///< likewise
  /// Where each step says whether its rows that only push are those that should; must outlive the solver. Null: nowhere.
  bool* agrees = nullptr;
  /// Longest way of a part in a step, cell edges or rad: all speeds are cut down alike to keep it. Null: any.
  const double* longest_way = nullptr;
};

/// A solver for the engine that meets all joint equations of a step at once (RowSystem), and with them those of the
/// contacts that press: the equations are solved again until no contact pulls and none that would have to press is left out.
/// Contacts are frictionless, and yield a little before the joints do: where a drive presses parts into each other, they
/// overlap, and the structure stays whole.
///
/// A joint that only pushes (is_one_sided) is one of the equations likewise, as long as its force pushes. Where twenty
/// solutions of a step do not agree on what pushes, the last is taken, and DirectSolverSettings::agrees says so.
///
/// A cord is one impulse on all its bodies, which only pulls. It yields as much as a joint to the ground.
///
/// Elastic hinges are the same equations with the equations of their turning springs added: a row whose
/// target closes its gap within one step h, at stiffness s over the parts' masses, is an undamped spring of
/// stiffness s / h^2 integrated by implicit Euler, so at rest forces balance as those springs' do. Where
/// a step with all that turns with the bodies has no least energy, or takes a part far, only what resists is
/// kept.
/// @pre a body that may not move along or turn about every axis has the same inertia about each;
/// with elastic hinges, cords and hands, the bodies' user indices are their indices in the structure
std::unique_ptr<btConstraintSolver> make_direct_solver(const DirectSolverSettings& settings);

/// Sets the engine up to solve all joints together, afresh every step.
void prepare_for_joints(btDiscreteDynamicsWorld& world);

}  // namespace kinetix::sim
