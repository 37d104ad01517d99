#include "model/elastic/path/drive_load.hpp"

#include "model/elastic/path/path_direction.hpp"

namespace kinetix::model {
namespace {

// k_turn by k_point edge^2: half of the default hinge's. At 1e-7 the forces that are left short of the goal,
// where states are taken at rough tolerances, show as limit points of a sheet of 32 x 32 cells.
constexpr double soft_turning = 5e-7;

/// How fast the drive's coordinate goes along a direction: cell edges or rad, by rad of theta.
double drive_speed(const ElasticSystem& system, const State& state, double theta,
                   const Eigen::VectorXd& along) {
  if (!system.holds_coordinate())
    return system.drive_rate(theta) * system.travel() / system.structure().size.edge_mm;
  return system.driven_gradient(state).dot(along);
}

}  // namespace

bool turns_softly(const ElasticSystem& system) { return system.stiffness().least_turn() < soft_turning; }

double load_along_path(const ElasticSystem& system, const State& state, double theta,
                       const TangentStiffness& tangent) {
  const Eigen::VectorXd along =
      system.place_rate(theta) + path_direction(system, state, theta, theta, tangent);
  return system.elastic_gradient(state).dot(along) / drive_speed(system, state, theta, along);
}

double drive_load(const ElasticSystem& system, const State& state, double theta,
                  const TangentStiffness& tangent, bool stable) {
  const bool has_path = stable && theta != 0 && !system.drive().heats_springs();
  return has_path && turns_softly(system) ? load_along_path(system, state, theta, tangent)
                                          : system.load(state, theta);
}

}  // namespace kinetix::model
