#include "model/elastic/path/path_direction.hpp"

namespace kinetix::model {

Eigen::VectorXd path_direction(const ElasticSystem& system, const State& state, double theta,
                               double placed_at, const TangentStiffness& tangent) {
  Eigen::VectorXd pull = tangent.multiply_all(system.place_rate(placed_at));
  if (system.driven_hinge() >= 0)
    pull += -ElasticSystem::grip * system.drive_rate(theta) * system.driven_gradient(state);
  return -system.dofs().extend(tangent.solve(system.dofs().restrict(pull)));
}

}  // namespace kinetix::model
