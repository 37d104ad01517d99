#pragma once

#include <vector>

#include "model/closure_drive.hpp"
#include "sim/row_system.hpp"

namespace kinetix {

/// Turning springs in the hinges, and a driven hinge, as equations for the direct solver. The engine has
/// neither: it cuts its springs down to what a step can bear, and its angular joints count Euler angles,
/// which leave the turn of model/closure_drive.hpp where the two axes of a stretched hinge part.
class TurnSprings {
 public:
  /// One spring a hinge, relaxed at flat. @param structure must outlive this
  /// @param weight of a spring's equation, over that of a hinge point: the ratio of the stiffnesses
  TurnSprings(const Structure& structure, double weight);

  /// From now on, one hinge is driven to an angle. @param angle rad, (-pi, pi)
  void drive_to(int hinge, double angle, double weight);

  /// Sets where each hinge's spring is relaxed. @param angles by hinge, rad, (-pi, pi)
  void relax_at(const std::vector<double>& angles);

  /// By implicit Euler, a spring leads each turn back to its rest within a step as far as its weight allows.
  /// @param turns, speeds of the bodies: R of the state, rad/s   @param step s
  /// @return equations on changes of speed, a and b being bodies of the structure
  std::vector<VelocityRow> rows(const State& turns, const std::vector<Eigen::Vector3d>& speeds,
                                double step) const;

 private:
  struct Spring {
    HingeTurn goal;
    double weight = 0;
  };

  VelocityRow row(const Spring& spring, const State& turns, const std::vector<Eigen::Vector3d>& speeds,
                  double step) const;

  const Structure& structure_;
  std::vector<Spring> springs_;  ///< by hinge, then the drive
};

}  // namespace kinetix
