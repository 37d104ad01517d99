#pragma once

#include <optional>

#include "model/contact/wall_contact.hpp"
#include "model/lattice/square/family/exact_family.hpp"
#include "optim/solvers/solver.hpp"
#include "optim/space_curve/space_fit.hpp"
#include "targets/space_curve/space_goal.hpp"

namespace kinetix::optim {

/// Direction across a strip, which is constant during the fold, and the slope of the goal against it.
struct Across {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitY();  ///< unit vector (dimensionless)
  double slope = 0;   ///< largest |d across / d along the curve seen along it| of the goal, ratio
  double arc_mm = 0;  ///< its position along the goal
};

/// Returns the direction with the smallest largest slope of the goal.
/// @param stretch mm over which slopes are averaged, > 0: features shorter than two columns do not count
Across min_slope(const targets::SpaceGoal& goal, double stretch);

/// Returns the direction with the smallest mean square slope. A goal with one steep place is nearest to a strip along
/// it. @param stretch as of min_slope
Across mean_slope(const targets::SpaceGoal& goal, double stretch);

/// Returns the frame of a strip with its width along `direction`. Unit columns: along the strip's plane,
/// across, up.
Eigen::Matrix3d frame_across(const targets::SpaceGoal& goal, const Eigen::Vector3d& direction);

/// Variables of a search for a strip in space.
struct SpaceVariables {
  int columns = 96;                        ///< >= 4
  model::CellSize size = {};               ///< of the cells
  bool free_edge = true;                   ///< the cell edge follows from the goal's length
  bool free_walls = true;                  ///< if the edge is free, thickness and height scale with it
  double beta = 60 * radians_per_degree;   ///< largest |tilt|, rad, (0, pi/2)
  std::array<double, 2> t = {0.12, 0.88};  ///< of shearing columns, within (0, 1)
  AngleRange theta{20 * radians_per_degree, 40 * radians_per_degree};  ///< rad, in (0, pi/4)
  int thetas = 5;  ///< tried between the ends of its range if the edge is free, >= 1

  /// @throws InvalidInput naming field, value and rule
  void validate() const;
};

/// Place where the goal is beyond the limits of a column.
struct SpaceObstacle {
  double arc_mm = 0;    ///< along the goal
  std::string why;      ///< one sentence, without advice
  bool climbs = false;  ///< whether the goal is too steep, which more columns do not change
};

/// Returns the worst place that no strip of these variables can follow, or nullopt if each column can do its
/// part.
std::optional<SpaceObstacle> obstacle(const targets::SpaceGoal& goal, const SpaceVariables& variables);

/// Strip found.
struct SpaceDesign {
  model::ExactDesign<double> design;
  model::CellSize size;
  SpaceStrip strip;   ///< in the frame of the strip
  Across across;      ///< in the goal's frame
  model::Pose place;  ///< of the goal, in the frame of the states that the design folds to
  targets::SpaceError error;
  SolveResult search;
  model::ContactLimit contact;  ///< first wall contact up to its theta, if any
  int tried = 0;                ///< number of thetas
  /// Place that the strip cannot follow within the limits of its columns, if any. The strip is then the nearest.
  std::optional<SpaceObstacle> obstacle = {};
};

/// Fits the strip: y along the direction of least slope, turns and climbs by least squares. If the edge is
/// free, theta is chosen among those whose walls do not meet. Tilts, fractions and theta itself then stay far
/// from their bounds. A goal out of reach gets the nearest strip and its obstacle.
/// @throws InvalidInput for invalid variables
SpaceDesign fit_space_curve(const targets::SpaceGoal& goal, const SpaceVariables& variables,
                            const SolverOptions& options);

/// Returns the middle of each column of bodies of a strip of one row, mm. @param state in the lattice's order
std::vector<Eigen::Vector3d> space_midline(const model::State& state);

}  // namespace kinetix::optim
