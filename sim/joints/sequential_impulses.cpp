#include "sim/joints/sequential_impulses.hpp"

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>

#include <algorithm>
#include <vector>

namespace kinetix::sim {
namespace {

class SweepSolver final : public btSequentialImpulseConstraintSolver {
 public:
  btScalar solveGroup(btCollisionObject** bodies, int body_count, btPersistentManifold** contacts,
                      int contact_count, btTypedConstraint** joints, int joint_count,
                      const btContactSolverInfo& info, btIDebugDraw* draw,
                      btDispatcher* dispatcher) override {
    std::vector<btTypedConstraint*> ordered(joints, joints + joint_count);
    std::sort(ordered.begin(), ordered.end(), [](const auto* a, const auto* b) {
      return a->getUserConstraintId() < b->getUserConstraintId();
    });
    return btSequentialImpulseConstraintSolver::solveGroup(
        bodies, body_count, contacts, contact_count, ordered.data(), joint_count, info, draw, dispatcher);
  }

 private:
  btScalar solveSingleIteration(int iteration, btCollisionObject** bodies, int body_count,
                                btPersistentManifold** contacts, int contact_count,
                                btTypedConstraint** joints, int joint_count, const btContactSolverInfo& info,
                                btIDebugDraw* draw) override {
    if (iteration > 0) {
      int* const rows = &m_orderNonContactConstraintPool[0];
      std::reverse(rows, rows + m_orderNonContactConstraintPool.size());
    }
    return btSequentialImpulseConstraintSolver::solveSingleIteration(
        iteration, bodies, body_count, contacts, contact_count, joints, joint_count, info, draw);
  }
};

}  // namespace

std::unique_ptr<btConstraintSolver> make_sequential_impulses() { return std::make_unique<SweepSolver>(); }

}  // namespace kinetix::sim
