#pragma once

#include "model/closure/closure.hpp"
#include "model/hinge/elasticity.hpp"
#include "model/linkage/linkage.hpp"
#include "model/linkage/state.hpp"
#include "sim/joints/row_system.hpp"

namespace kinetix::sim {

/// Directions of a hinge's own frame for the poses of its two bodies. Each is half way between the directions
/// carried by the two bodies: of the wall (made perpendicular to the axis) and of the axis. Unit vectors.
struct HingeDirections {
  Eigen::Vector3d wall, axis;  ///< dimensionless
};
HingeDirections hinge_directions(const model::RestHinge& hinge, const model::Pose& lower,
                                 const model::Pose& upper);

/// Pull of a hinge on its two bodies: derivatives of its stretch energy with the hinge's directions held.
/// They are by the mismatch of the hinge point and by that of the unit axis, lower minus upper.
struct HingePull {
  Eigen::Vector3d point;  ///< k_point edge
  Eigen::Vector3d axis;   ///< k_point edge^2
  /// Part of `point` from the stiffness in the hinge's frame, which need not be along the mismatch: k_point
  /// edge. Left zero for hinges with clearance.
  Eigen::Vector3d framed_point = Eigen::Vector3d::Zero();
  Eigen::Vector3d framed_axis = Eigen::Vector3d::Zero();  ///< that part of `axis`, k_point edge^2
};
HingePull hinge_pull(const model::RestHinge& hinge, const model::Stiffness& stiffness,
                     const model::Pose& lower, const model::Pose& upper, double edge_mm);

/// Appends the equations of the two points of a hinge with stiffness in its own frame
/// (model/hinge/elasticity.hpp). Each is an undamped spring by implicit Euler. Every point has three of the
/// shear stiffness in space. One along the wall's direction and one along the axis add the difference to
/// their stiffness, with a negative weight if that is smaller. A hinge with a separate tilt stiffness has
/// these equations for its hinge point and its axis instead. A hinge with clearance
/// (model/hinge/clearance_energy.hpp) has springs beyond the clearance at each point, across the axis and along
/// it. A brake acts on sliding round in its bore.
/// @param edge_mm cell edge  @param state mm  @param speeds rad/s and cell edges/s  @param step s
void append_framed_points(const model::RestHinge& hinge, const model::Stiffness& stiffness, double edge_mm,
                          const model::State& state, const std::vector<model::Twist>& speeds, double step,
                          std::vector<VelocityRow>& rows);

/// Part of elastic hinges beyond the equations of their two points: turning springs, a driven hinge, points
/// with stiffness in the hinge's frame, and forces that turn with their bodies. The engine has none of these.
/// It limits its springs to what a step can handle. Its angular joints use Euler angles, which differ from
/// the turn of model/closure/closure.hpp if the two axes of a stretched hinge differ.
class ElasticHinges {
 public:
  /// Makes springs relaxed at flat. @param structure must outlive this
  /// @throws InvalidInput if per-hinge stiffnesses differ in number from the hinges
  ElasticHinges(const model::Linkage& structure, const model::Stiffness& stiffness);

  /// Drives one hinge to an angle from now on. @param angle rad, (-pi, pi)
  /// @param weight over that of a hinge point
  void drive_to(int hinge, double angle, double weight);

  /// Adds one more spring to each of these hinges from now on.
  /// @param weight of every spring, as Stiffness::turn   @param angles rest angles, rad, (-pi, pi); one per
  /// hinge
  void add_springs(const std::vector<int>& hinges, const std::vector<double>& angles, double weight);

  /// Sets the rest angle of each hinge's turning spring. @param angles by hinge, rad, (-pi, pi)
  void relax_at(const std::vector<double>& angles);

  /// Returns the equations of a step. Each spring moves its turn back to rest within the step as far as its
  /// weight allows (implicit Euler). A brake also reduces each body's turning speed. Its weight is the
  /// resistance of the present hinge forces to a turn of their arms.
  /// @param state mm; @param speeds of the bodies, rad/s and cell edges/s; @param step s.
  /// @return equations on changes of speed, with a and b bodies of the structure or -1. They have the same a
  /// and b in the same order at every call after the first drive_to or add_springs.
  std::vector<VelocityRow> rows(const model::State& state, const std::vector<model::Twist>& speeds,
                                double step) const;

 private:
  struct Spring {
    model::HingeTurn goal;
    std::shared_ptr<const model::HingeLaw> law;
    double weight = 0;  ///< the law's k_turn
  };

  VelocityRow row(const Spring& spring, const model::State& state, const std::vector<model::Twist>& speeds,
                  double step) const;

  const model::Linkage& structure_;
  const model::Stiffness stiffness_;
  std::vector<Spring> springs_;  ///< by hinge, then those of the drive
};

/// Returns the largest force that any hinge exerts by a point or by the turning spring (moment over the cell
/// edge), in units of k_point edge.
double largest_hinge_force(const model::Linkage& structure, const model::State& state,
                           const model::Stiffness& stiffness);

}  // namespace kinetix::sim
