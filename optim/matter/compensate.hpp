#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>

#include "model/elastic/path/equilibrium_path.hpp"
#include "model/lattice/lattice.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "model/tolerance/observed_points.hpp"
#include "optim/matter/tilt_ties.hpp"

namespace kinetix::optim {

/// A goal that equilibria are brought to.
struct MatterGoal {
  /// How far the points of a state are from it, in the state's own frame. None: it cannot be said.
  std::function<std::vector<model::ObservedPoint>(const model::Lattice&, const model::State&)> observe;
  /// The drive that takes a sheet to theta, rad.
  std::function<model::LinkageDrive(const model::Lattice&, double theta)> drive;
};

struct CompensationOptions {
  /// Of the sheet that is started from: which tilts change together, and how far.
  std::function<std::vector<TiltTie>(const model::Lattice&)> ties = tilt_ties;
  double enough_mm = 0;                         ///< an rms at which the search ends, >= 0
  double tilt = 75 * radians_per_degree;        ///< of any hinge at most, rad, in (0, pi/2)
  double least_theta = 2 * radians_per_degree;  ///< rad
  double most_theta = 44 * radians_per_degree;  ///< rad
  int rounds = 30;                              ///< of steps tried, >= 0
  bool contact = true;                          ///< walls push each other away
  std::stop_token stop = {};                    ///< where it asks to, the best so far is the answer
};

/// A sheet in equilibrium with its drive.
struct InMatter {
  model::Lattice sheet;
  double theta = 0;  ///< rad, of the drive
  model::State state;
  double rms_mm = 0;  ///< from the goal
};

struct Compensation {
  InMatter before, after;
  double largest_change = 0;  ///< of a tilt, rad
  int rounds = 0;             ///< steps tried
  std::string why;            ///< it ended
};

/// The deviations of an equilibrium from its goal and how they change.
struct DeviationJacobian {
  Eigen::VectorXd deviations;  ///< of each point, mm, what a rigid motion takes away left out
  Eigen::MatrixXd jacobian;    ///< a row a point: by the tilt of each tie, last by theta; mm/rad
};

/// By the adjoint. @param at in equilibrium   @return nothing at a limit of the equilibrium
std::optional<DeviationJacobian> deviation_jacobian(const InMatter& at, const std::vector<TiltTie>& ties,
                                                    const model::Elasticity& elasticity,
                                                    const MatterGoal& goal, bool contact);

/// Brings the equilibrium of a sheet of elastic hinges onto its goal: springs hold a fold back and blocks stretch, so
/// that a design which meets its goal exactly misses it in matter. Tilts (tied, options.ties) and theta
/// change by Gauss and Newton's steps, damped as by Levenberg and Marquardt, with the derivatives of the adjoint; the
/// equilibrium is followed from step to step.
/// @param start in equilibrium   @throws InvalidInput for an elasticity out of range
Compensation compensate(const InMatter& start, const model::Elasticity& elasticity, const MatterGoal& goal,
                        const CompensationOptions& options = {});

}  // namespace kinetix::optim
