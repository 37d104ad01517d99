#include "model/elastic/adjoint.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/elastic_equilibrium.hpp"

namespace kinetix::model {
namespace {

using namespace testing;

Sensitivity of_equilibrium(const Equilibrium& b, const EquilibriumGradient& gradient) {
  ElasticSystem system(b.structure, b.elasticity, drive_on(b.structure, b.drive), b.planar, true);
  system.set_multiplier(b.multiplier);
  TangentStiffness tangent(system.dofs());
  system.linearise(b.state, b.theta, tangent);
  EXPECT_TRUE(tangent.factorise(0));
  return sensitivity(system, b.elasticity, b.state, b.theta, tangent, gradient);
}

void expect_central_differences(unsigned repeats) {
  for (const EquilibriumCase& c : equilibrium_cases(repeats)) {
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

TEST(Adjoint, IsTheCentralDifferenceOfEquilibriaFoundAnew) { expect_central_differences(1); }

TEST(AdjointSoak, IsTheCentralDifferenceOfEquilibriaFoundAnew) { expect_central_differences(4); }

TEST(Adjoint, EnergyGrowsWithThetaByTheWorkOfTheLoad) {
  for (const EquilibriumCase& c : equilibrium_cases(3)) {
    SCOPED_TRACE(to_string(c));
    const Equilibrium b = random_equilibrium(c);
    const double way = c.plates ? 2 * b.structure.size.edge_mm * std::sin(b.theta)
                                : -2 * drive_on(b.structure, b.drive).sense;
    EXPECT_NEAR(of_equilibrium(b, {{}, 0, 1}).theta, b.load * way, 1e-8 * std::abs(b.load * way));
  }
}

TEST(Adjoint, OfManyFunctionsIsThatOfEach) {
  for (const EquilibriumCase& c : equilibrium_cases(2)) {
    SCOPED_TRACE(to_string(c));
    const Equilibrium b = random_equilibrium(c);
    ASSERT_TRUE(b.found);
    ElasticSystem system(b.structure, b.elasticity, drive_on(b.structure, b.drive), b.planar, true);
    system.set_multiplier(b.multiplier);
    TangentStiffness tangent(system.dofs());
    system.linearise(b.state, b.theta, tangent);
    ASSERT_TRUE(tangent.factorise(0));
    const DesignSensitivities all(system, b.state, b.theta, tangent);
    std::mt19937 random(3);
    std::normal_distribution<double> normal(0, 1);
    for (int k = 0; k < 5; ++k) {
      Eigen::VectorXd by_state(6 * b.state.size());
      for (double& entry : by_state) entry = normal(random);
      const Sensitivity each = sensitivity(system, b.elasticity, b.state, b.theta, tangent, {by_state, 0, 0});
      const DesignSensitivity one = all.of(by_state);
      EXPECT_LE((one.hinges - each.hinges).norm(), 1e-12 * each.hinges.norm());
      EXPECT_NEAR(one.theta, each.theta, 1e-12 * std::abs(each.theta));
    }
  }
}

/// Scaling turning springs, points and contacts together does not move an equilibrium.
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

/// Gives each hinge its own elasticity with a frame of three stiffnesses. One hinge in three has both tilt stiffnesses,
/// one has only the twist stiffness, and one has neither.
Elasticity by_hinge(Elasticity whole, std::size_t hinges) {
  for (std::size_t h = 0; h < hinges; ++h) {
    const double wave = std::cos(1.0 + static_cast<double>(h));
    HingeStiffness k{2000 + 500 * wave, 800 - 200 * wave, 1200, 20 + 5 * wave};
    if (h % 3 == 1) k.rock = 9000 + 3000 * wave;
    if (h % 3 != 0) k.twist = 12000 - 3000 * wave;
    Elasticity own = elasticity_of(k, 3 + wave);
    own.k_contact = whole.k_contact;
    whole.each.push_back(own);
  }
  return whole;
}

Equilibrium by_hinge(Equilibrium b) {
  b.elasticity = by_hinge(b.elasticity, b.structure.hinges.size());
  settle(b);
  return b;
}

/// Returns the equilibrium after a hinge's own stiffness or reach grows by a ratio. @param k place among its seven values
Equilibrium with_hinge_stiffness(Equilibrium at, Eigen::Index hinge, int k, double ratio) {
  Elasticity& own = at.elasticity.each[hinge];
  HingeStiffness stiffness = stiffness_of(own);
  double* const fields[] = {&stiffness.axial,
                            &stiffness.shear,
                            &stiffness.along,
                            &stiffness.turn,
                            &own.reach_mm,
                            &stiffness.rock.emplace(stiffness.rock.value_or(0)),
                            &stiffness.twist.emplace(stiffness.twist.value_or(0))};
  *fields[k] *= ratio;
  if (*stiffness.rock == 0) stiffness.rock.reset();
  if (*stiffness.twist == 0) stiffness.twist.reset();
  own = elasticity_of(stiffness, own.reach_mm);
  settle(at);
  return at;
}

/// Compares the derivatives by the stiffnesses of hinges with central differences. @param every nth hinge
void expect_central_differences_by_hinge(Eigen::Index every) {
  const std::vector<StateFunction> functions = state_functions();
  for (const EquilibriumCase& c : equilibrium_cases(1)) {
    SCOPED_TRACE(to_string(c));
    const Equilibrium b = by_hinge(random_equilibrium(c));
    ASSERT_TRUE(b.found);
    const auto hinges = static_cast<Eigen::Index>(b.structure.hinges.size());
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(functions.size(), 7 * hinges), found = expected;
    for (Eigen::Index h = 0; h < hinges; h += every)
      for (int k = 0; k < 7; ++k) {
        const auto values = [&](const Eigen::VectorXd& q) {
          const Equilibrium at = with_hinge_stiffness(b, h, k, 1 + q[0]);
          Eigen::VectorXd all(functions.size());
          for (std::size_t f = 0; f < functions.size(); ++f) all[f] = functions[f].value(at);
          return all;
        };
        expected.col(7 * h + k) =
            testing::numeric_jacobian(values, Eigen::VectorXd::Zero(1), c.touching ? 1e-4 : 1e-3);
      }
    for (std::size_t f = 0; f < functions.size(); ++f) {
      const Sensitivity s = of_equilibrium(b, functions[f].gradient(b));
      for (Eigen::Index h = 0; h < hinges; h += every) {
        const Elasticity& own = b.elasticity.each[h];
        const HingeStiffness k = stiffness_of(own);
        const Eigen::Vector<double, 7> values(k.axial, k.shear, k.along, k.turn, own.reach_mm,
                                              k.rock.value_or(0), k.twist.value_or(0));
        found.row(f).segment<7>(7 * h) = s.stiffness.col(h).cwiseProduct(values).transpose();
      }
      EXPECT_LE((found - expected).row(f).norm(), 1e-6 * expected.row(f).norm()) << functions[f].name;
    }
  }
}

/// Hinges differ in kind from one to the next, in a cycle of three. Every fourth hinge has every kind.
TEST(Adjoint, OfHingesOfTheirOwnIsTheCentralDifferenceOfEquilibriaFoundAnew) {
  expect_central_differences_by_hinge(4);
}

TEST(AdjointSoak, OfHingesOfTheirOwnIsTheCentralDifferenceOfEquilibriaFoundAnew) {
  expect_central_differences_by_hinge(1);
}

void expect_central_differences_of_framed_hinges(unsigned repeats) {
  unsigned compared = 0;
  for (const EquilibriumCase& c : equilibrium_cases(repeats)) {
    SCOPED_TRACE(to_string(c));
    Equilibrium b = random_equilibrium(c);
    b.elasticity.ratios = {1, 0.3, 0.5};
    settle(b);
    ASSERT_TRUE(b.found);
    const Differenced differences = differenced_jacobian(b);
    if (!differences.same_contacts) continue;
    ++compared;
    EXPECT_LE(relative_difference_by_groups(adjoint_jacobian(b), differences.jacobian, parameter_groups(b)),
              1e-6);
  }
  EXPECT_GE(compared, 6 * repeats) << "of " << 8 * repeats;
}

TEST(Adjoint, OfFramedHingesByDesignIsTheCentralDifferenceOfEquilibriaFoundAnew) {
  expect_central_differences_of_framed_hinges(1);
}

TEST(AdjointSoak, OfFramedHingesByDesignIsTheCentralDifferenceOfEquilibriaFoundAnew) {
  expect_central_differences_of_framed_hinges(2);
}

/// Hinges with their own tilt stiffnesses keep these when their points become stiffer.
TEST(Adjoint, OfHingesWithTiltStiffnessesOfTheirOwnIsTheCentralDifferenceOfEquilibriaFoundAnew) {
  for (const EquilibriumCase& c : equilibrium_cases(1))
    for (const TiltStiffness& tilt : {TiltStiffness{9000, {}}, TiltStiffness{{}, 12000}}) {
      if (c.planar || c.touching) continue;
      SCOPED_TRACE(to_string(c) + (tilt.rock ? ", rock" : ", twist"));
      Equilibrium b = random_equilibrium(c);
      b.elasticity.tilt = tilt;
      settle(b);
      ASSERT_TRUE(b.found);
      const Differenced differences = differenced_jacobian(b);
      EXPECT_TRUE(differences.same_contacts);
      EXPECT_LE(relative_difference_by_groups(adjoint_jacobian(b), differences.jacobian, parameter_groups(b)),
                1e-6);
    }
}

/// Doubling the stiffness in all directions equals doubling k_point.
TEST(Adjoint, ByTheDirectionsOfAllHingesTogetherIsThatByKPoint) {
  for (const EquilibriumCase& c : equilibrium_cases(1)) {
    SCOPED_TRACE(to_string(c));
    const Equilibrium b = random_equilibrium(c);
    for (const StateFunction& f : state_functions()) {
      const Sensitivity s = of_equilibrium(b, f.gradient(b));
      const HingeStiffness k = stiffness_of(b.elasticity);
      const Eigen::Vector3d all(k.axial, k.shear, k.along);
      const double sum = (s.stiffness.topRows<3>().transpose() * all).sum();
      EXPECT_NEAR(sum, s.k_point * b.elasticity.k_point, 1e-9 * (std::abs(sum) + 1e-3)) << f.name;
    }
  }
}

}  // namespace
}  // namespace kinetix::model
