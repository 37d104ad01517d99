#include "model/elastic/path/drive_load.hpp"

#include <cmath>

#include "model/elastic/path/path_direction.hpp"

namespace kinetix::model {
namespace {

// Ratio of k_turn to k_point edge^2, half of that of the default hinge. At 1e-7, residual forces of states at
// rough tolerances before the goal appear as limit points of a sheet of 32 x 32 cells.
constexpr double soft_turning = 5e-7;

/// Returns the speed of the drive's coordinate along a direction: cell edges or rad, per rad of theta.
double drive_speed(const ElasticSystem& system, const State& state, double theta,
                   const Eigen::VectorXd& along) {
  if (!system.holds_coordinate())
    return system.drive().coordinate_rate(theta) * system.drive().travel(system.structure()) /
           system.structure().size.edge_mm;
  return system.driven_gradient(state).dot(along);
}

constexpr double difference = 2e-5;  // rad of theta: of central differences
// Iterations that refine the direction of a path. Its factor may be that of a state 2e-3 before, and each
// iteration leaves an error of about the square of that distance.
constexpr int refinements = 2;
// k_point edge or edge^2: for smaller loads, the residual of Newton's method would dominate a difference.
constexpr double least_load = 1e-7;

/// Returns the load of a state in equilibrium to first order, without the multiplier.
double load_of(const ElasticSystem& system, const State& state, double theta) {
  if (!system.holds_coordinate()) return system.load(state, theta);
  const Eigen::VectorXd by_drive = system.dofs().restrict(system.driven_gradient(state));
  return system.dofs().restrict(system.elastic_gradient(state)).dot(by_drive) / by_drive.squaredNorm();
}

}  // namespace

bool turns_softly(const ElasticSystem& system) { return system.stiffness().least_turn() < soft_turning; }

double load_along_path(const ElasticSystem& system, const State& state, double theta,
                       const TangentStiffness& tangent) {
  const Eigen::VectorXd along =
      system.place_rate(theta) + path_direction(system, state, theta, theta, tangent);
  return system.elastic_gradient(state).dot(along) / drive_speed(system, state, theta, along);
}

double load_stiffness(const ElasticSystem& system, const State& state, double theta,
                      const TangentStiffness& tangent) {
  const double rate = system.drive().coordinate_rate(theta);
  if (rate == 0 || !(std::abs(system.load(state, theta)) > least_load)) return NAN;
  const Eigen::VectorXd along =
      system.place_rate(theta) + path_direction(system, state, theta, theta, tangent, refinements);
  const auto load = [&](double by) { return load_of(system, system.retract(state, by * along), theta + by); };
  return (load(difference) - load(-difference)) / (2 * difference * rate);
}

double drive_load(const ElasticSystem& system, const State& state, double theta,
                  const TangentStiffness& tangent, bool stable) {
  const bool has_path = stable && theta != 0 && system.drive().acts_from_outside();
  return has_path && turns_softly(system) ? load_along_path(system, state, theta, tangent)
                                          : system.load(state, theta);
}

}  // namespace kinetix::model
