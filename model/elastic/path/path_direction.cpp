#include "model/elastic/path/path_direction.hpp"

namespace kinetix::model {

Eigen::VectorXd path_direction(const ElasticSystem& system, const State& state, double theta,
                               double placed_at, const TangentStiffness& tangent) {
  Eigen::VectorXd pull = tangent.multiply_all(system.place_rate(placed_at));
  if (system.holds_coordinate())
    pull += -ElasticSystem::grip * system.driven_rate(placed_at) * system.driven_gradient(state);
  if (system.drive().heats_springs()) pull += system.drive_rate(theta) * system.spring_gradient(state);
  return -system.dofs().extend(tangent.solve(system.dofs().restrict(pull)));
}

}  // namespace kinetix::model
