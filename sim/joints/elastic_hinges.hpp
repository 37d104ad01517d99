#pragma once

#include <memory>
#include <vector>

#include "model/closure/closure_drive.hpp"
#include "model/hinge/elasticity.hpp"
#include "sim/joints/row_system.hpp"

namespace kinetix::sim {

/// What the direct solver must know of elastic hinges beyond the equations of their two points: turning
/// springs, a driven hinge, points that pull by the directions of the hinge's own frame, and how forces turn
/// with their bodies. The engine has none of them: it cuts its springs down to what a step can bear, and its
/// angular joints count Euler angles, which leave the turn of model/closure/closure_drive.hpp where the two
/// axes of a stretched hinge part.
class ElasticHinges {
 public:
  /// Springs relaxed at flat. @param structure must outlive this
  /// @throws InvalidInput for stiffnesses by hinge of another number than there are hinges
  ElasticHinges(const model::Linkage& structure, const model::Stiffness& stiffness);

  /// From now on, one hinge is driven to an angle. @param angle rad, (-pi, pi)
  /// @param weight over that of a hinge point
  void drive_to(int hinge, double angle, double weight);

  /// From now on, hinges have one more spring each. @param weight of every one, as Stiffness::turn
  /// @param angles at which they rest, rad, (-pi, pi); as many as hinges
  void add_springs(const std::vector<int>& hinges, const std::vector<double>& angles, double weight);

  /// Sets where each hinge's turning spring is relaxed. @param angles by hinge, rad, (-pi, pi)
  void relax_at(const std::vector<double>& angles);

  /// By implicit Euler, a spring leads each turn back to its rest within a step as far as its weight allows.
  /// Likewise each body's turning speed is led to zero with the weight of what its hinges' present forces
  /// would oppose to a turn of their arms, as far as they oppose it.
  /// @param state mm; @param speeds of the bodies, rad/s and cell edges/s; @param step s
  /// @return equations on changes of speed, a and b being bodies of the structure or -1; the same a and b in
  /// the same order at every call after the first drive_to or add_springs
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
