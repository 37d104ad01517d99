#pragma once

#include <memory>

class btConstraintSolver;
class btDiscreteDynamicsWorld;

namespace kinetix::sim {

class Cord;
class ElasticHinges;
class ExternalPulls;

struct DirectSolverSettings {
  double joint_stiffness = 1e4;  ///< as in PhysicsOptions, over the parts' masses
  double grip = 100;             ///< ratio of the stiffness of a joint to the ground to that of a hinge
  /// Ratio of the stiffness of a hinge to that of a contact. With elastic hinges all points of a wall tip edge
  /// together are one contact, otherwise each point is.
  double contact_softness = 10;
  double edge_mm = 1;                      ///< cell edge of the structure of `elastic`, `cord` and `hand`
  const ElasticHinges* elastic = nullptr;  ///< null for none; must outlive the solver
  const Cord* cord = nullptr;              ///< null for none; must outlive the solver
  const ExternalPulls* external_pulls = nullptr;  ///< null for none; must outlive the solver
  /// Output of each step: whether its one-sided rows are consistent. Must outlive the solver; null: not
  /// reported.
  bool* agrees = nullptr;
  /// Longest motion of a part per step, cell edges or rad. All speeds are scaled down by one factor to keep
  /// it. Null: no limit.
  const double* max_motion = nullptr;
};

/// Makes a solver for the engine that solves all joint equations of a step together (RowSystem), with those
/// of the pressing contacts. The equations are solved again until no contact pulls and every contact that has
/// to press is included. Contacts are frictionless, and yield a little before the joints do. If a drive
/// presses parts into each other, they overlap and the structure stays whole.
///
/// A joint that only pushes (is_one_sided) is one of the equations as long as its force pushes. If twenty
/// solutions of a step do not agree on the pushing rows, the last is used, and DirectSolverSettings::agrees
/// is false.
///
/// A tendon is one impulse on all its bodies, which only pulls. It yields as much as a joint to the ground.
///
/// Elastic hinges are the same equations plus those of their turning springs. A row closes its gap within one
/// step h, at stiffness s over the parts' masses. It is an undamped spring of stiffness s / h^2 integrated by
/// implicit Euler, so forces at rest balance as those springs' do. Forces that turn with the bodies can leave
/// a step without a minimum of energy, or move a part far. Then only rows that resist are kept.
/// @pre a body that may not move along or turn about every axis has the same inertia about each. With elastic
/// hinges, tendons and hands, the bodies' user indices are their indices in the structure.
std::unique_ptr<btConstraintSolver> make_direct_solver(const DirectSolverSettings& settings);

/// Sets the engine up to solve all joints together, without reuse between steps.
void prepare_for_joints(btDiscreteDynamicsWorld& world);

}  // namespace kinetix::sim
