#include <gtest/gtest.h>

#include "model/base/invalid_input.hpp"
#include "model/elastic/elastic_system.hpp"
#include "model/lattice/square/family/classification.hpp"
#include "sim/joints/elastic_hinges.hpp"

namespace kinetix::sim {
namespace {

/// Energy 1/4 k_turn turn^4.
class CubicHinge final : public model::HingeLaw {
 public:
  model::TurnResponse at(double turn, double k) const override {
    const double cubed = turn * turn * turn;
    return {0.25 * k * turn * cubed, 3 * k * turn * turn, turn / 3, 0.25 * turn * cubed, cubed};
  }
};

// A basic cell at theta: every hinge has turned by 2 theta and nothing is stretched.
TEST(ElasticLaw, ThePhysicsRunPullsWithTheMomentAndStiffnessOfTheLaw) {
  const double theta = 0.4, step = 1e-3, k = 0.2;
  const model::Linkage cell = model::make_structure(model::rectangle(1, 1), {});
  const model::State state = exact_motion(model::make_structure(model::rectangle(1, 1), {})).at(theta);
  const model::Stiffness cubic{.turn = k, .law = std::make_shared<CubicHinge>()};
  const std::vector<model::Twist> still(state.size());
  const std::vector<VelocityRow> rows = ElasticHinges(cell, cubic).rows(state, still, step);
  const double turn = 2 * theta;
  for (std::size_t h = 0; h < cell.hinges.size(); ++h) {
    EXPECT_NEAR(rows[h].weight, 3 * k * turn * turn, 1e-12);
    EXPECT_NEAR(std::abs(rows[h].weight * rows[h].target * step), k * turn * turn * turn, 1e-12);
  }
  EXPECT_NEAR(largest_hinge_force(cell, state, cubic), k * turn * turn * turn, 1e-12);
}

TEST(ElasticLaw, IsOneForAllHingesOrOneForEach) {
  const model::Linkage cell = model::make_structure(model::rectangle(1, 1), {});
  model::Elasticity elasticity;
  for (const std::size_t count : {0u, 4u}) {
    elasticity.each.assign(count, model::Elasticity{});
    EXPECT_NO_THROW(ElasticHinges(cell, relative(elasticity, 10)));
    EXPECT_NO_THROW(model::ElasticSystem(cell, elasticity, true, false));
  }
  elasticity.each.resize(3);
  EXPECT_THROW(ElasticHinges(cell, relative(elasticity, 10)), InvalidInput);
  EXPECT_THROW(model::ElasticSystem(cell, elasticity, true, false), InvalidInput);
}

}  // namespace
}  // namespace kinetix::sim
