#include "model/elastic/path_direction.hpp"

namespace kinetix::model {
namespace {

using Eigen::VectorXd;

/// What a driven hinge pulls with as its turn goes on; nothing for plates.
VectorXd turn_pull(const ElasticSystem& system, const State& state, double theta) {
  VectorXd pull = VectorXd::Zero(system.dofs().coordinates());
  if (system.driven_hinge() < 0) return pull;
  const RestHinge& hinge = system.hinges()[system.driven_hinge()];
  const Vector12 by_theta =
      -ElasticSystem::grip * system.drive_rate(theta) * system.driven_turn(state).gradient;
  pull.segment<6>(6 * hinge.lower) = by_theta.head<6>();
  pull.segment<6>(6 * hinge.upper) = by_theta.tail<6>();
  return pull;
}

}  // namespace

VectorXd path_direction(const ElasticSystem& system, const State& state, double theta, double placed_at,
                        const TangentStiffness& tangent) {
  const VectorXd pull = tangent.multiply_all(system.place_rate(placed_at)) + turn_pull(system, state, theta);
  return -system.dofs().extend(tangent.solve(system.dofs().restrict(pull)));
}

}  // namespace kinetix::model
