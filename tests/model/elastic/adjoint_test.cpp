#include "model/elastic/adjoint.hpp"

#include <gtest/gtest.h>

#include "tests/support/elastic_equilibrium.hpp"

namespace kinetix::model {
namespace {

using namespace testing;

Sensitivity of_equilibrium(const Equilibrium& b, const EquilibriumGradient& gradient) {
  ElasticSystem system(b.structure, b.elasticity, b.drive.on(b.structure), b.planar, true);
  system.set_multiplier(b.multiplier);
  TangentStiffness tangent(system.dofs());
  system.linearise(b.state, b.theta, tangent);
  EXPECT_TRUE(tangent.factorise(0));
  return sensitivity(system, b.elasticity, b.state, b.theta, tangent, gradient);
}

TEST(Adjoint, IsTheCentralDifferenceOfEquilibriaFoundAnew) {
  for (const EquilibriumCase& c : equilibrium_cases(5)) {
    SCOPED_TRACE(to_string(c));
    const Equilibrium b = random_equilibrium(c);
    ASSERT_TRUE(b.found);
    EXPECT_EQ(b.contacts.empty(), !c.touching);
    const Differenced differences = differenced_jacobian(b);
    EXPECT_TRUE(differences.same_contacts);
    EXPECT_LE(relative_difference_by_groups(adjoint_jacobian(b), differences.jacobian, parameter_groups(b)),
              1e-6);
  }
}

TEST(Adjoint, EnergyGrowsWithThetaByTheWorkOfTheLoad) {
  for (const EquilibriumCase& c : equilibrium_cases(3)) {
    SCOPED_TRACE(to_string(c));
    const Equilibrium b = random_equilibrium(c);
    const double way =
        c.plates ? 2 * b.structure.size.edge_mm * std::sin(b.theta) : -2 * b.drive.wall.from.sense();
    EXPECT_NEAR(of_equilibrium(b, {{}, 0, 1}).theta, b.load * way, 1e-8 * std::abs(b.load * way));
  }
}

/// Turning springs, points and contacts scaled together leave an equilibrium where it is.
TEST(Adjoint, StatesDependOnRatiosOfStiffnessesAlone) {
  for (const EquilibriumCase& c : equilibrium_cases(3)) {
    SCOPED_TRACE(to_string(c));
    const Equilibrium b = random_equilibrium(c);
    const Elasticity& e = b.elasticity;
    const Sensitivity s = of_equilibrium(b, state_functions().front().gradient(b));
    const double sum = s.k_point * e.k_point + s.k_turn * e.k_turn + s.k_contact * e.k_contact;
    EXPECT_NEAR(sum, 0, 1e-12 * std::abs(s.k_point * e.k_point));
    EXPECT_NE(s.k_point, 0);
    EXPECT_EQ(s.k_contact != 0, c.touching);
  }
}

TEST(Adjoint, OfNothingIsZeroAndOfNaNIsNaN) {
  for (const EquilibriumCase& c : equilibrium_cases(1)) {
    SCOPED_TRACE(to_string(c));
    const Equilibrium b = random_equilibrium(c);
    const Sensitivity zero = of_equilibrium(b, {});
    EXPECT_EQ(zero.hinges.cols(), static_cast<Eigen::Index>(b.structure.hinges.size()));
    EXPECT_EQ(packed(b, zero).cwiseAbs().maxCoeff(), 0);
    const Eigen::VectorXd nan = Eigen::VectorXd::Constant(6 * b.state.size(), NAN);
    const Eigen::RowVectorXd of_nan = packed(b, of_equilibrium(b, {nan, 0, 0}));
    EXPECT_TRUE(of_nan.head(of_nan.size() - 2).array().isNaN().all());
    EXPECT_EQ(std::isnan(of_nan.tail<2>()[0]), !b.planar);
    EXPECT_EQ(std::isnan(of_nan.tail<1>()[0]), c.touching);
  }
}

}  // namespace
}  // namespace kinetix::model
