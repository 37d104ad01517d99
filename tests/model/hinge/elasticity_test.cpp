#include <gtest/gtest.h>
#include <cmath>
#include <random>
#include <tuple>

#include "model/elastic/path/equilibrium_path.hpp"
#include "model/hinge/elasticity.hpp"
#include "model/hinge/hinge_energy.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "tests/support/derivatives.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/random_elastic.hpp"

namespace kinetix::model {
namespace {

using testing::expect_jacobian;

/// Smallest user-defined law: the energy 1/4 k_turn turn^4, a spring that stiffens with its turn.
class CubicHinge final : public HingeLaw {
 public:
  TurnResponse at(double turn, double k) const override {
    const double cubed = turn * turn * turn;
    return {0.25 * k * turn * cubed, 3 * k * turn * turn, turn / 3, 0.25 * turn * cubed, cubed};
  }
};

Eigen::VectorXd one(double value) { return Eigen::VectorXd::Constant(1, value); }

TEST(HingeLaw, MomentStiffnessAndRatesOfALawAreDerivativesOfItsEnergy) {
  const CubicHinge cubic;
  const LinearHinge linear;
  const SetHinge set(0.9);
  for (const HingeLaw* law : {static_cast<const HingeLaw*>(&cubic), static_cast<const HingeLaw*>(&linear),
                              static_cast<const HingeLaw*>(&set)})
    for (const double turn : {-2.5, -0.3, 0.0, 0.7, 3.0})
      for (const double k : {0.2, 5.0}) {
        const TurnResponse r = law->at(turn, k);
        Eigen::MatrixXd by_turn(2, 1), by_k(2, 1);
        by_turn << r.moment(), r.stiffness;
        by_k << r.energy_k, r.moment_k;
        const auto energy_and_moment = [](const TurnResponse& at) -> Eigen::VectorXd {
          return Eigen::Vector2d(at.energy, at.moment());
        };
        expect_jacobian([&](const Eigen::VectorXd& x) { return energy_and_moment(law->at(x[0], k)); },
                        one(turn), by_turn);
        expect_jacobian([&](const Eigen::VectorXd& x) { return energy_and_moment(law->at(turn, x[0])); },
                        one(k), by_k);
      }
}

TEST(HingeLaw, OfASetHingeIsThatOfATurnFromWhereItWasSetByTheShorterWay) {
  const double k = 5;
  for (const auto& [set, turn, away] :
       {std::tuple(0.9, 0.9, 0.0), {0.9, 1.2, 0.3}, {-0.4, 0.1, 0.5}, {3.0, -3.0, 2 * pi - 6}}) {
    const TurnResponse r = SetHinge(set).at(turn, k);
    EXPECT_NEAR(r.energy, 0.5 * k * away * away, 1e-14) << set << " " << turn;
    EXPECT_NEAR(r.moment(), k * away, 1e-14) << set << " " << turn;
  }
}

class CubicPanel : public ::testing::Test {
 protected:
  std::mt19937 random_{7};
  const Structure panel_ = testing::random_panel(1, 1, random_);
  const State state_ = testing::shaken(panel_, rest_state(panel_), 0.5, random_);
  const Stiffness stiff_{.turn = 0.3, .reach = 0.4, .law = std::make_shared<CubicHinge>()};

  Element element(const RestHinge& h, const Stiffness& k, const Pose& lower, const Pose& upper) const {
    return hinge_element(h, k, lower, upper, panel_.size.edge_mm);
  }
};

TEST_F(CubicPanel, GradientAndHessianOfItsHingesMatchCentralDifferences) {
  for (const Hinge& hinge : panel_.hinges) {
    const RestHinge h = rest_hinge(hinge);
    const Pose &lower = state_[h.lower], &upper = state_[h.upper];
    // The upper body turned by x about its position.
    const auto energy = [&](const Eigen::VectorXd& x) {
      Pose turned = upper;
      turned.R = Eigen::AngleAxisd(x.norm(), x.stableNormalized()) * upper.R;
      return one(element(h, stiff_, lower, turned).energy);
    };
    const auto gradient = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
      return testing::numeric_jacobian(energy, x, 1e-3).transpose();
    };
    const Element e = element(h, stiff_, lower, upper);
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(3);
    expect_jacobian(energy, zero, e.gradient.segment<3>(6).transpose());
    expect_jacobian(gradient, zero, e.hessian.block<3, 3>(6, 6), 1e-6, 3e-3);
    const Vector12 alone = hinge_gradient(h, stiff_, lower, upper, panel_.size.edge_mm);
    EXPECT_LE((alone - e.gradient).norm(), 1e-14 * (1 + e.gradient.norm()));
    EXPECT_NEAR(hinge_energy(h, stiff_, lower, upper, panel_.size.edge_mm).total(), e.energy, 1e-14);
  }
}

TEST_F(CubicPanel, RatesByStiffnessOfItsHingesMatchCentralDifferences) {
  for (const Hinge& hinge : panel_.hinges) {
    const RestHinge h = rest_hinge(hinge);
    const Pose &lower = state_[h.lower], &upper = state_[h.upper];
    const Vector12 along = Vector12::Random();
    const auto energy_and_slope = [&](const Eigen::VectorXd& k) -> Eigen::VectorXd {
      Stiffness changed = stiff_;
      changed.turn = k[0];
      const Element e = element(h, changed, lower, upper);
      return Eigen::Vector2d(e.energy, e.gradient.dot(along));
    };
    const HingeGradients derivatives = hinge_gradients(h, stiff_, lower, upper, panel_.size.edge_mm, along);
    expect_jacobian(energy_and_slope, one(stiff_.turn),
                    Eigen::Vector2d(derivatives.energy.turn, derivatives.along.turn));
  }
}

// A basic cell strains nothing: its four hinges turn by 2 theta each, and the drive lifts them all.
TEST(HingeLaw, ACellOfCubicHingesIsDrivenByFourTimesTheMomentOfOne) {
  const Structure cell = make_structure(rectangle(1, 1), {});
  // Pins this stiff give by k_turn / (k_point edge^2) = 1e-9 of a cell edge. The load is the stiffness that
  // holds the drive, 100 k_point edge^2, times the error that rounding leaves: some 1e-6 N mm.
  const Elasticity cubic{.k_point = 1e6, .k_turn = 0.1, .law = std::make_shared<CubicHinge>()};
  for (const double theta : {0.3, -0.5}) {
    const HingeTurn drive = hinge_drive_to(cell, cell.hinges[0].wall, theta);
    const EquilibriumPath path = trace_equilibrium(driven(cell, drive), cubic, testing::without_contact());
    ASSERT_EQ(path.stop, EquilibriumPath::Stop::reached) << path.why;
    const double turn = drive.angle;
    EXPECT_NEAR(path.steps.back().energy, 4 * 0.25 * 0.1 * std::pow(turn, 4), 1e-8);
    EXPECT_NEAR(path.steps.back().load, 4 * 0.1 * std::pow(turn, 3), 1e-5);
    EXPECT_LE(path.gaps.max, 1e-8);
  }
}

}  // namespace
}  // namespace kinetix::model
