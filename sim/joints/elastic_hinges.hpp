#pragma once

#include <memory>
#include <vector>

#include "model/closure/closure_drive.hpp"
#include "model/hinge/elasticity.hpp"
#include "sim/joints/row_system.hpp"

namespace kinetix::sim {

/// Part of elastic hinges beyond the equations of their two points: turning springs, a driven hinge, points
/// with stiffness in the hinge's frame, and forces that turn with their bodies. The engine has none of these.
/// It limits its springs to what a step can handle. Its angular joints use Euler angles, which differ from
/// the turn of model/closure/closure_drive.hpp if the two axes of a stretched hinge differ.
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

}  // namespace kinetix::sim
