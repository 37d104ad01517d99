#include "sim/joints/direct_solver.hpp"

#include <BulletCollision/CollisionDispatch/btSimulationIslandManager.h>
#include <BulletDynamics/ConstraintSolver/btGeneric6DofSpring2Constraint.h>
#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>
#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "sim/joints/elastic_hinges.hpp"
#include "sim/joints/external_pulls.hpp"
#include "sim/joints/joints.hpp"
#include "sim/joints/row_system.hpp"
#include "sim/shapes/part_shape.hpp"

namespace kinetix::sim {
namespace {

// Cell edges or rad, motion of a part in one step with all forces turning with their bodies: the linearised
// forces are inaccurate beyond.
constexpr double longest_step = 0.05;

/// Returns the direction in which a one-sided joint pushes its second part, unit vector.
Eigen::Vector3d inward(const btTypedConstraint& joint) {
  const auto& spring = static_cast<const btGeneric6DofSpring2Constraint&>(joint);
  return eigen(spring.getCalculatedTransformA().getBasis().getColumn(0));
}

Vector6 stacked(const btVector3& linear, const btVector3& angular) {
  return {linear.x(), linear.y(), linear.z(), angular.x(), angular.y(), angular.z()};
}

Eigen::Matrix3d world_inertia(const btRigidBody& body) {
  const Eigen::Vector3d principal = eigen(body.getLocalInertia());
  if ((principal.array() == principal.x()).all()) return principal.asDiagonal();
  const Eigen::Matrix3d R = eigen(body.getWorldTransform().getBasis());
  return R * principal.asDiagonal() * R.transpose();
}

// Solutions of a step, until the set of pushing rows is the same twice. Panels of a thousand contacts need
// seven.
constexpr int max_solutions = 20;

/// Row that only pushes its two parts apart: of a joint that presses, or of a contact.
struct OneSided {
  VelocityRow row;
  double apart = 1;  ///< sign of the speed along the row when the parts separate
  bool pushes = false;
};

/// Effect of a tendon, by the parts.
struct Pull {
  Eigen::VectorXd direction, response;
  double mobility = 0;  ///< speed of shortening by a unit impulse
  double target = 0;    ///< required change of that speed
};

/// Bodies of the structure in the engine at the start of a step.
struct Motion {
  model::State state;
  std::vector<model::Twist> speeds;
  std::vector<int> part_of_body;
};

class DirectSolver final : public btSequentialImpulseConstraintSolver {
 public:
  explicit DirectSolver(const DirectSolverSettings& settings) : settings_(settings) {}

 private:
  btScalar solveGroupCacheFriendlyIterations(btCollisionObject**, int, btPersistentManifold** manifolds,
                                             int count, btTypedConstraint**, int,
                                             const btContactSolverInfo& info, btIDebugDraw*) override {
    number_parts();
    const bool jointless = m_tmpSolverNonContactConstraintPool.size() == 0 && !settings_.elastic;
    if (bodies_.empty() || jointless) return 0;
    share_contacts(manifolds, count);
    collect_rows(info.m_timeStep);
    Eigen::VectorXd velocities = solution(info.m_timeStep);
    for (std::size_t k = 0; k < pushed_.size(); ++k) pushed_[k] = one_sided_[k].pushes;
    if (settings_.max_motion) shorten(velocities, *settings_.max_motion / info.m_timeStep);
    apply(velocities);
    return 0;
  }

  /// Returns the changes of speed for a consistent set of pushing rows, or the last of max_solutions.
  Eigen::VectorXd solution(double step) {
    Eigen::VectorXd velocities;
    bool agrees = false;
    for (int k = 0; k < max_solutions && !agrees; ++k) {
      velocities = of_rows(step);
      if (settings_.cord) tighten(*settings_.cord, step, velocities);
      agrees = !choose(velocities);
    }
    if (settings_.agrees) *settings_.agrees = agrees;
    return velocities;
  }

  void number_parts() {
    part_of_.assign(m_tmpSolverBodyPool.size(), -1);
    bodies_.clear();
    masses_.clear();
    dofs_.clear();
    for (int k = 0; k < m_tmpSolverBodyPool.size(); ++k) {
      btRigidBody* const body = m_tmpSolverBodyPool[k].m_originalBody;
      if (!body || !(body->getInvMass() > 0)) continue;
      part_of_[k] = static_cast<int>(bodies_.size());
      bodies_.push_back(k);
      masses_.push_back({1 / body->getInvMass(), world_inertia(*body)});
      dofs_.push_back(stacked(body->getLinearFactor(), body->getAngularFactor()));
    }
  }

  Vector6 free_part(int part, const btVector3& linear, const btVector3& angular) const {
    const Vector6 all = stacked(linear, angular);
    return part < 0 ? all : all.cwiseProduct(dofs_[part]);
  }

  VelocityRow row_of(const btSolverConstraint& c) const {
    const int a = part_of_[c.m_solverBodyIdA], b = part_of_[c.m_solverBodyIdB];
    return {a,
            b,
            free_part(a, c.m_contactNormal1, c.m_relpos1CrossNormal),
            free_part(b, c.m_contactNormal2, c.m_relpos2CrossNormal),
            c.m_rhs / c.m_jacDiagABInv,
            a < 0 || b < 0 ? settings_.grip : 1};
  }

  void collect_rows(double step) {
    rows_.clear();
    one_sided_.clear();
    for (int k = 0; k < m_tmpSolverNonContactConstraintPool.size(); ++k)
      if (m_tmpSolverNonContactConstraintPool[k].m_jacDiagABInv > 0)
        append_joint(m_tmpSolverNonContactConstraintPool[k]);
    if (pushed_.size() != one_sided_.size()) pushed_.assign(one_sided_.size(), true);
    for (std::size_t k = 0; k < pushed_.size(); ++k) one_sided_[k].pushes = pushed_[k];
    if (settings_.elastic || has_pulls()) append_local(step);
    two_sided_ = rows_.size();
    append_contacts();
  }

  void append_contacts() {
    for (int k = 0; k < m_tmpSolverContactConstraintPool.size(); ++k) {
      const btSolverConstraint& point = m_tmpSolverContactConstraintPool[k];
      if (!(point.m_jacDiagABInv > 0)) continue;
      VelocityRow row = row_of(point);
      const auto sharing = sharing_.find(point.m_originalContactPoint);
      row.weight = 1 / (settings_.contact_softness * (sharing == sharing_.end() ? 1 : sharing->second));
      one_sided_.push_back({row});
    }
    // The system combines consecutive rows of the same two parts.
    std::stable_sort(one_sided_.begin() + pushed_.size(), one_sided_.end(),
                     [](const OneSided& x, const OneSided& y) {
                       return std::pair(x.row.a, x.row.b) < std::pair(y.row.a, y.row.b);
                     });
  }

  /// Keeps the rows that push, or would have to. @param v changes of speed of the step
  /// @return whether the set changed
  bool choose(const Eigen::VectorXd& v) {
    bool changed = false;
    for (OneSided& one : one_sided_) {
      const bool pushes = one.apart * (one.row.target - along(one.row, v)) > 0;
      changed = changed || one.pushes != pushes;
      one.pushes = pushes;
    }
    return changed;
  }

  // In a row of a joint, the engine's contact point is the joint.
  void append_joint(const btSolverConstraint& c) {
    const auto& joint = *static_cast<const btTypedConstraint*>(c.m_originalContactPoint);
    const VelocityRow row = row_of(c);
    if (is_one_sided(joint))
      one_sided_.push_back({row, row.second.head<3>().dot(inward(joint))});
    else
      rows_.push_back(row);
  }

  /// Returns the changes of speed by the two-sided rows and the pushing one-sided rows.
  Eigen::VectorXd of_rows(double step) {
    rows_.resize(two_sided_);
    for (const OneSided& one : one_sided_)
      if (one.pushes) rows_.push_back(one.row);
    const bool solvable = system_.factorise(masses_, rows_, settings_.joint_stiffness);
    if (solvable || !settings_.elastic) {
      const Eigen::VectorXd velocities = system_.velocities();
      if (!settings_.elastic || fastest_after(velocities) * step <= longest_step) return velocities;
    }
    factorise_resisting_rows();
    return system_.velocities();
  }

  /// Returns the largest speed or turning speed after changes of speed.
  double fastest_after(const Eigen::VectorXd& change) const {
    double longest = 0;
    for (std::size_t p = 0; p < bodies_.size(); ++p)
      longest = std::max(longest, (speed_of(p) + change.segment<6>(6 * p)).cwiseAbs().maxCoeff());
    return longest;
  }

  Vector6 speed_of(std::size_t part) const {
    const btRigidBody& body = *m_tmpSolverBodyPool[bodies_[part]].m_originalBody;
    return stacked(body.getLinearVelocity(), body.getAngularVelocity());
  }

  /// Scales changes of speed so that no part is faster than this.
  void shorten(Eigen::VectorXd& change, double fastest) const {
    const double factor = fastest / fastest_after(change);
    if (!(factor < 1)) return;
    for (std::size_t p = 0; p < bodies_.size(); ++p) {
      const Vector6 before = speed_of(p);
      change.segment<6>(6 * p) = factor * (before + change.segment<6>(6 * p)) - before;
    }
  }

  void factorise_resisting_rows() {
    for (VelocityRow& row : rows_)
      if (row.weight < 0) row.weight = 0;
    system_.factorise(masses_, rows_, settings_.joint_stiffness);
  }

  Motion motion() const {
    Motion now{model::State(bodies_.size()), std::vector<model::Twist>(bodies_.size()),
               std::vector<int>(bodies_.size())};
    for (std::size_t p = 0; p < bodies_.size(); ++p) {
      const btRigidBody& body = *m_tmpSolverBodyPool[bodies_[p]].m_originalBody;
      now.state[body.getUserIndex()] = pose_of(body.getWorldTransform(), settings_.edge_mm);
      now.speeds[body.getUserIndex()] = {eigen(body.getAngularVelocity()), eigen(body.getLinearVelocity())};
      now.part_of_body[body.getUserIndex()] = static_cast<int>(p);
    }
    return now;
  }

  bool has_pulls() const { return settings_.external_pulls && !settings_.external_pulls->is_empty(); }

  /// Appends the rows that the engine does not have.
  void append_local(double step) {
    const Motion now = motion();
    if (settings_.elastic) append(settings_.elastic->rows(now.state, now.speeds, step), now);
    if (has_pulls()) append(settings_.external_pulls->rows(now.state, now.speeds, step), now);
  }

  /// Appends rows, translated from bodies to parts. @param rows by the bodies of the structure
  void append(const std::vector<VelocityRow>& rows, const Motion& now) {
    for (VelocityRow row : rows) {
      row.a = now.part_of_body[row.a];
      row.first = row.first.cwiseProduct(dofs_[row.a]);
      if (row.b >= 0) {
        row.b = now.part_of_body[row.b];
        row.second = row.second.cwiseProduct(dofs_[row.b]);
      }
      rows_.push_back(row);
    }
  }

  static double along(const VelocityRow& row, const Eigen::VectorXd& v) {
    double sum = 0;
    if (row.a >= 0) sum += row.first.dot(v.segment<6>(6 * row.a));
    if (row.b >= 0) sum += row.second.dot(v.segment<6>(6 * row.b));
    return sum;
  }

  void share_contacts(btPersistentManifold** manifolds, int count) {
    sharing_.clear();
    for (int m = 0; settings_.elastic && m < count; ++m) count_points_on_edges(*manifolds[m], sharing_);
  }

  Pull pull_of(const Cord& cord, double step) const {
    const Motion now = motion();
    const Eigen::VectorXd pull = cord.pull(now.state);
    Pull out;
    out.direction = Eigen::VectorXd::Zero(6 * static_cast<Eigen::Index>(masses_.size()));
    out.target = cord.excess(now.state) / step;
    for (std::size_t b = 0; b < now.state.size(); ++b) {
      const int part = now.part_of_body[b];
      const Vector6 own = pull.segment<6>(6 * static_cast<Eigen::Index>(b)).cwiseProduct(dofs_[part]);
      out.direction.segment<6>(6 * part) = own;
      out.target -= own.head<3>().dot(now.speeds[b].v) + own.tail<3>().dot(now.speeds[b].omega);
    }
    out.response = system_.response(out.direction);
    out.mobility = out.direction.dot(out.response);
    return out;
  }

  /// Adds the tendon's part of the changes of speed if it is taut.
  void tighten(const Cord& cord, double time_step, Eigen::VectorXd& velocities) const {
    const Pull pull = pull_of(cord, time_step);
    const double compliance = 1 / (settings_.grip * settings_.joint_stiffness);
    const double miss = pull.target - pull.direction.dot(velocities);
    if (miss > 0) velocities += miss / (pull.mobility + compliance) * pull.response;
  }

  void apply(const Eigen::VectorXd& v) {
    for (std::size_t p = 0; p < bodies_.size(); ++p) {
      btSolverBody& body = m_tmpSolverBodyPool[bodies_[p]];
      const double* const w = v.data() + 6 * p;
      body.internalGetDeltaLinearVelocity().setValue(w[0], w[1], w[2]);
      body.internalGetDeltaAngularVelocity().setValue(w[3], w[4], w[5]);
    }
  }

  const DirectSolverSettings settings_;
  std::vector<int> part_of_;  ///< by solver body; -1 for a fixed one
  std::vector<int> bodies_;   ///< solver body of each part
  std::vector<PartMass> masses_;
  std::vector<Vector6> dofs_;        ///< 1 for directions in which a part may move, otherwise 0
  std::vector<VelocityRow> rows_;    ///< two-sided rows, then those of one_sided_ that push
  std::size_t two_sided_ = 0;        ///< number of two-sided rows
  std::vector<OneSided> one_sided_;  ///< of joints, then of contacts
  std::vector<bool> pushed_;         ///< whether each of those joints pushed at the end of the last step
  PointCounts sharing_;              ///< by point: number of points that share its contact
  RowSystem system_;
};

}  // namespace

void prepare_for_joints(btDiscreteDynamicsWorld& world) {
  btContactSolverInfo& info = world.getSolverInfo();
  info.m_splitImpulse = false;
  info.m_solverMode &= ~SOLVER_USE_WARMSTARTING;
  world.getSimulationIslandManager()->setSplitIslands(false);
}

std::unique_ptr<btConstraintSolver> make_direct_solver(const DirectSolverSettings& settings) {
  return std::make_unique<DirectSolver>(settings);
}

}  // namespace kinetix::sim
