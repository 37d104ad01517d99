#pragma once

#include "model/elastic/path/equilibrium_path.hpp"
#include "model/lattice/lattice.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "model/tolerance/print_tolerance.hpp"
#include "optim/elastic/tilt_ties.hpp"

namespace kinetix::optim {

/// Goal of an equilibrium.
struct ElasticGoal {
  /// Returns the deviations of a state's points from the goal, in the state's own frame. Empty: unknown.
  std::function<std::vector<model::ObservedPoint>(const model::Lattice&, const model::State&)> observe;
  /// Returns the drive that moves a sheet to theta, rad.
  std::function<model::LinkageDrive(const model::Lattice&, double theta)> drive;
};

struct CompensationOptions {
  /// Ties of the sheet at the start: tilts that change together, with their ranges.
  std::function<std::vector<TiltTie>(const model::Lattice&)> ties = tilt_ties;
  double enough_mm = 0;                        ///< rms at which the search ends, >= 0
  double tilt = 75 * radians_per_degree;       ///< largest tilt of any hinge, rad, in (0, pi/2)
  double min_theta = 2 * radians_per_degree;   ///< rad
  double max_theta = 44 * radians_per_degree;  ///< rad
  int rounds = 30;                             ///< number of steps tried, >= 0
  bool contact = true;                         ///< walls push each other apart
  std::stop_token stop = {};                   ///< on request, the best so far is the result
};

/// Sheet in equilibrium with its drive.
struct ElasticFit {
  model::Lattice sheet;
  double theta = 0;  ///< rad, of the drive
  model::State state;
  double rms_mm = 0;  ///< deviation from the goal
};

struct Compensation {
  ElasticFit before, after;
  double largest_change = 0;  ///< of a tilt, rad
  int rounds = 0;             ///< steps tried
  std::string why;            ///< reason for the end
};

/// Deviations of an equilibrium from its goal and their derivatives.
struct DeviationJacobian {
  Eigen::VectorXd deviations;  ///< of each point, mm, after optimal rigid alignment
  Eigen::MatrixXd jacobian;    ///< one row per point: by the tilt of each tie, last by theta; mm/rad
};

/// Computes the derivatives by the adjoint. @param at in equilibrium
/// @return nullopt at a limit of the equilibrium
std::optional<DeviationJacobian> deviation_jacobian(const ElasticFit& at, const std::vector<TiltTie>& ties,
                                                    const model::Elasticity& elasticity,
                                                    const ElasticGoal& goal, bool contact);

/// Changes a sheet with elastic hinges so that its equilibrium meets the goal. Springs resist the fold and
/// blocks stretch, so an exact design misses its goal with elastic hinges. Tilts (tied, options.ties) and
/// theta change by Levenberg-Marquardt steps with derivatives by the adjoint. The equilibrium is followed
/// from step to step.
/// @param start in equilibrium   @throws InvalidInput for an elasticity out of range
Compensation compensate(const ElasticFit& start, const model::Elasticity& elasticity, const ElasticGoal& goal,
                        const CompensationOptions& options = {});

}  // namespace kinetix::optim
