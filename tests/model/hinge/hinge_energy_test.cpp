#include "model/hinge/hinge_energy.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "model/closure/closure.hpp"
#include "model/closure/closure_drive.hpp"
#include "tests/support/derivatives.hpp"
#include "tests/support/random_elastic.hpp"

namespace kinetix::model {
namespace {

using testing::expect_jacobian;
using testing::random_panel;
using testing::shaken;

// Turn (over k_point edge^2), reach (cell edges) and contact (over k_point): all of the order of one, so
// that no part of the energy hides an error in another.
const Stiffness stiff{0.3, 0.4, 10};

/// The twists of the two bodies of a hinge, written into those of all.
State moved_pair(const Structure& s, const State& state, const Hinge& hinge, const Vector12& x) {
  Eigen::VectorXd twists = Eigen::VectorXd::Zero(6 * s.bodies.size());
  twists.segment<6>(6 * hinge.lower) = x.head<6>();
  twists.segment<6>(6 * hinge.upper) = x.tail<6>();
  return moved(s, state, twists);
}

Element element_of(const Structure& s, const State& state, const Hinge& hinge) {
  return hinge_element(rest_hinge(hinge), stiff, state[hinge.lower], state[hinge.upper], s.size.edge_mm);
}

/// With t, alpha and beta changed by the first three entries.
/// Hinges beside their walls, each by another distance.
Structure with_offsets(Structure s) {
  for (std::size_t k = 0; k < s.hinges.size(); ++k)
    s.hinges[k].parameters.offset = 0.1 * std::cos(1.0 + static_cast<double>(k));
  return s;
}

RestHinge redesigned(Hinge hinge, const Eigen::VectorXd& by) {
  hinge.parameters.t += by[0];
  hinge.parameters.alpha += by[1];
  hinge.parameters.beta += by[2];
  hinge.parameters.offset += by[3];
  return rest_hinge(hinge);
}

/// f . grad of the energy at x by a difference of the elements' gradients needs the gradient at a moved state
/// in the moved coordinates: to first order they differ by half a commutator, which the symmetric Hessian
/// leaves out. So second derivatives are those of the energy.
Eigen::VectorXd numeric_gradient(const std::function<double(const Vector12&)>& f, const Vector12& x) {
  return testing::numeric_jacobian(
             [&](const Eigen::VectorXd& y) { return Eigen::VectorXd::Constant(1, f(y)); }, x, 1e-3)
      .transpose();
}

TEST(HingeEnergy, IsThatOfTwoPointSpringsAndATurningSpring) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const Structure s = random_panel(2, 2, random);
    const State state = shaken(s, rest_state(s), 0.4, random);
    for (const Hinge& hinge : s.hinges) {
      const Eigen::Vector3d d = hinge_axis(hinge.wall.axis, hinge.parameters);
      const auto carried = [&](int body, double side) -> Eigen::Vector3d {
        const Eigen::Vector3d rest = s.hinge_point(hinge) + side * stiff.reach * s.size.edge_mm * d;
        return state[body].p + state[body].R * (rest - s.rest_position(body));
      };
      double springs = 0;
      for (const double side : {-1.0, 1.0})
        springs += 0.5 * (carried(hinge.lower, side) - carried(hinge.upper, side)).squaredNorm();
      const double turn = hinge_turn(s, state, static_cast<int>(&hinge - s.hinges.data()));
      const double expected = springs / (s.size.edge_mm * s.size.edge_mm) + 0.5 * stiff.turn * turn * turn;
      EXPECT_NEAR(element_of(s, state, hinge).energy, expected, 1e-13 * (1 + expected));
      EXPECT_NEAR(
          hinge_energy(rest_hinge(hinge), stiff, state[hinge.lower], state[hinge.upper], s.size.edge_mm)
              .total(),
          expected, 1e-13 * (1 + expected));
    }
  }
}

TEST(HingeEnergy, GradientAndHessianMatchCentralDifferences) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 20; ++trial) {
    const Structure s = with_offsets(random_panel(1, 1, random));
    const State state = shaken(s, rest_state(s), 0.5, random);
    for (const Hinge& hinge : s.hinges) {
      const auto energy = [&](const Vector12& x) {
        return element_of(s, moved_pair(s, state, hinge, x), hinge).energy;
      };
      const Element e = element_of(s, state, hinge);
      const Vector12 alone =
          hinge_gradient(rest_hinge(hinge), stiff, state[hinge.lower], state[hinge.upper], s.size.edge_mm);
      EXPECT_LE((alone - e.gradient).norm(), 1e-14 * (1 + e.gradient.norm()));
      const Eigen::VectorXd zero = Eigen::VectorXd::Zero(12);
      expect_jacobian([&](const Eigen::VectorXd& x) { return Eigen::VectorXd::Constant(1, energy(x)); }, zero,
                      e.gradient.transpose());
      expect_jacobian([&](const Eigen::VectorXd& x) { return numeric_gradient(energy, x); }, zero, e.hessian,
                      1e-6, 3e-3);
    }
  }
}

TEST(HingeEnergy, RatesByDesignAndStiffnessMatchCentralDifferences) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Structure s = with_offsets(random_panel(1, 1, random));
    const State state = shaken(s, rest_state(s), 0.5, random);
    for (const Hinge& hinge : s.hinges) {
      const auto energy_and_gradient = [&](const Eigen::VectorXd& q) -> Eigen::VectorXd {
        const RestHinge h = redesigned(hinge, q);
        const Element e = hinge_element(h, {stiff.turn + q[4], stiff.reach + q[5], stiff.contact},
                                        state[h.lower], state[h.upper], s.size.edge_mm);
        return (Eigen::VectorXd(13) << e.energy, e.gradient).finished();
      };
      Eigen::Matrix<double, 13, 6> all;
      for (int k = 0; k < 12; ++k) {
        const auto [energy, along] = hinge_rates(rest_hinge(hinge), stiff, state[hinge.lower],
                                                 state[hinge.upper], s.size.edge_mm, Vector12::Unit(k));
        all.row(0) << energy.design.transpose(), energy.turn, energy.reach;
        all.row(1 + k) << along.design.transpose(), along.turn, along.reach;
      }
      expect_jacobian(energy_and_gradient, Eigen::VectorXd::Zero(6), all);
    }
  }
}

TEST(HingeTurnElement, IsTheTurnOfTheHingeWithItsDerivatives) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 20; ++trial) {
    const Structure s = with_offsets(random_panel(1, 1, random));
    const State state = shaken(s, rest_state(s), 0.5, random);
    for (std::size_t k = 0; k < s.hinges.size(); ++k) {
      const Hinge& hinge = s.hinges[k];
      const auto turn = [&](const Vector12& x) {
        return hinge_turn(s, moved_pair(s, state, hinge, x), static_cast<int>(k));
      };
      const Element e = RelativeTurn(rest_hinge(hinge), state[hinge.lower], state[hinge.upper]).element();
      EXPECT_NEAR(e.energy, turn(Vector12::Zero()), 1e-14);
      expect_jacobian([&](const Eigen::VectorXd& x) { return numeric_gradient(turn, x); },
                      Eigen::VectorXd::Zero(12), e.hessian, 1e-6, 3e-3);
    }
  }
}

TEST(HingeTurnElement, RatesByDesignMatchCentralDifferences) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 20; ++trial) {
    const Structure s = with_offsets(random_panel(1, 1, random));
    const State state = shaken(s, rest_state(s), 0.5, random);
    for (const Hinge& hinge : s.hinges) {
      const auto turn_and_gradient = [&](const Eigen::VectorXd& q) -> Eigen::VectorXd {
        const RestHinge h = redesigned(hinge, q);
        const Element e = RelativeTurn(h, state[h.lower], state[h.upper]).element();
        return (Eigen::VectorXd(13) << e.energy, e.gradient).finished();
      };
      Eigen::Matrix<double, 13, 4> all;
      for (int k = 0; k < 12; ++k) {
        const TurnRates rates =
            turn_rates(rest_hinge(hinge), state[hinge.lower], state[hinge.upper], Vector12::Unit(k));
        all.row(0) = rates.turn.transpose();
        all.row(1 + k) = rates.along.transpose();
      }
      expect_jacobian(turn_and_gradient, Eigen::VectorXd::Zero(4), all);
    }
  }
}

}  // namespace
}  // namespace kinetix::model
