#pragma once

#include "model/linkage/state.hpp"
#include "sim/joints/row_system.hpp"

namespace kinetix::sim {

/// Tendon through hinge points (model/linkage/linkage_drive.hpp) for the direct solver. It pulls all its bodies
/// with one tension, without friction, and never pushes.
class Cord {
 public:
  /// Makes a tendon of its length at rest. @param structure must outlive this
  Cord(const model::Linkage& structure, std::vector<int> through);

  /// Sets the target length. @param length cell edges
  void shorten_to(double length) { goal_ = length; }
  /// Returns how much longer it is than its target, cell edges; negative if it is slack.
  double excess(const model::State& state) const;
  /// Returns the effect of a unit of tension on the bodies of the structure, six numbers per body: force (v),
  /// then moment (omega).
  Eigen::VectorXd pull(const model::State& state) const;

 private:
  const model::Linkage& structure_;
  const std::vector<int> through_;
  double goal_;  ///< target length, cell edges
};

/// Point of a body that is pulled towards a place by a spring without damping.
struct SpringPull {
  int body = 0;
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();  ///< from the vertex, in the rest frame, cell edges
  Eigen::Vector3d to = Eigen::Vector3d::Zero();   ///< target, cell edges
  double stiffness = 0;                           ///< mass / s^2
};

/// Body that is kept in place.
struct FixedBody {
  int body = 0;
  model::Pose place;  ///< mm
};

/// Hands that pull and hold a structure while it moves: equations for the direct solver, by implicit Euler.
class ExternalPulls {
 public:
  ExternalPulls(double joint_stiffness, double edge_mm)
      : joint_stiffness_(joint_stiffness), edge_mm_(edge_mm) {}

  std::vector<SpringPull> spring_pulls;
  std::vector<FixedBody> fixed_bodies;

  bool is_empty() const { return spring_pulls.empty() && fixed_bodies.empty(); }
  /// Returns the pull on the first grasped point, mass edge / s^2; zero if there is none.
  Eigen::Vector3d pull(const model::State& state) const;
  /// Returns the equations of a step. @param state mm; @param speeds rad/s and cell edges/s; @param step s
  std::vector<VelocityRow> rows(const model::State& state, const std::vector<model::Twist>& speeds,
                                double step) const;

 private:
  void append(const SpringPull& spring_pull, const model::Pose& pose, const model::Twist& speed, double step,
              std::vector<VelocityRow>& rows) const;
  void append(const FixedBody& fixed, const model::Pose& pose, const model::Twist& speed, double step,
              std::vector<VelocityRow>& rows) const;

  double joint_stiffness_;  ///< as in the solver
  double edge_mm_;
};

}  // namespace kinetix::sim
