#include "sim/joints/joint_order.hpp"

#include <BulletCollision/CollisionDispatch/btSimulationIslandManager.h>
#include <btBulletDynamicsCommon.h>

namespace kinetix::sim {

void prepare_for_joints(btDiscreteDynamicsWorld& world, int iterations) {
  btContactSolverInfo& info = world.getSolverInfo();
  info.m_numIterations = iterations;
  info.m_splitImpulse = false;
  info.m_solverMode &= ~SOLVER_USE_WARMSTARTING;
  world.getSimulationIslandManager()->setSplitIslands(false);
}

void add_in_order(btDiscreteDynamicsWorld& world, btTypedConstraint& joint) {
  joint.setUserConstraintId(world.getNumConstraints());
  world.addConstraint(&joint);
}

}  // namespace kinetix::sim
