#include "model/elastic/path/path_direction.hpp"

namespace kinetix::model {

Eigen::VectorXd path_direction(const ElasticSystem& system, const State& state, double theta,
                               double placed_at, const TangentStiffness& tangent, int refined) {
  Eigen::VectorXd pull = tangent.multiply_all(system.place_rate(placed_at));
  if (system.holds_coordinate())
    pull += -ElasticSystem::grip * system.driven_rate(placed_at) * system.driven_gradient(state);
  if (!system.drive().acts_from_outside())
    pull += system.drive().coordinate_rate(theta) * system.spring_gradient(state);
  const Eigen::VectorXd reduced = system.dofs().restrict(pull);
  Eigen::VectorXd along = tangent.solve(reduced);
  for (int k = 0; k < refined; ++k)
    along +=
        tangent.solve(reduced - system.dofs().restrict(tangent.multiply_all(system.dofs().extend(along))));
  return -system.dofs().extend(along);
}

}  // namespace kinetix::model
