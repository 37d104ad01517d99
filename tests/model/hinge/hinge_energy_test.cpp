#include "model/hinge/hinge_energy.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <random>

#include "model/closure/closure.hpp"
#include "model/hinge/clearance_energy.hpp"
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
/// Hinges with equal and with different stiffness per direction, with and without tilt stiffnesses and clearance.
const std::vector<Stiffness> kinds{stiff,
                                   {.turn = 0.3, .reach = 0.4, .ratios = {1, 0.3, 0.5}},
                                   {.turn = 0.3, .reach = 0.4, .ratios = {0.9, 1, 0.2}},
                                   {.turn = 0.3, .reach = 0, .ratios = {1, 0.3, 0.5}},
                                   {.turn = 0.3, .reach = 0.4, .tilt = {0.5, 0.2}},
                                   {.turn = 0.3, .reach = 0.4, .ratios = {1, 0.3, 0.5}, .tilt = {0.1, {}}},
                                   {.turn = 0.3, .reach = 0.4, .ratios = {1, 0.3, 0.5}, .tilt = {{}, 0.7}},
                                   {.turn = 0.3, .reach = 0.4, .ratios = {0.8, 0.8, 0.5}, .play = 0.2},
                                   {.turn = 0.3, .reach = 0.4, .ratios = {1, 1, 1}, .play = 0.02}};

std::optional<double> plus(const std::optional<double>& tilt, double by) {
  if (!tilt) return {};
  return *tilt + by;
}

/// Returns the state with the two bodies of a hinge moved by their twists x.
State moved_pair(const Linkage& s, const State& state, const Hinge& hinge, const Vector12& x) {
  Eigen::VectorXd twists = Eigen::VectorXd::Zero(6 * s.bodies.size());
  twists.segment<6>(6 * hinge.lower) = x.head<6>();
  twists.segment<6>(6 * hinge.upper) = x.tail<6>();
  return retract_straight(s, state, twists);
}

Element element_of(const Structure& s, const State& state, const Hinge& hinge, const Stiffness& k) {
  return hinge_element(rest_hinge(hinge), k, state[hinge.lower], state[hinge.upper], s.size.edge_mm);
}

/// Returns the structure with hinges off their walls, each by another distance.
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

/// Returns the gradient of f at x by central differences. Second derivatives are those of the energy. Differences of
/// the elements' gradients would need the gradient of a moved state in the moved coordinates. To first order the two
/// differ by half a commutator, which the symmetric Hessian leaves out.
Eigen::VectorXd numeric_gradient(const std::function<double(const Vector12&)>& f, const Vector12& x) {
  return testing::numeric_jacobian(
             [&](const Eigen::VectorXd& y) { return Eigen::VectorXd::Constant(1, f(y)); }, x, 1e-3)
      .transpose();
}

/// Returns the energy of a point's springs along the directions of the hinge's frame. The frame is half way
/// between the two bodies. @param gap cell edges
double spring_energy(const Stiffness& k, const Eigen::Vector3d& gap, const Eigen::Matrix3d& lower,
                     const Eigen::Matrix3d& upper, const Hinge& hinge) {
  const Eigen::Vector3d c0 = hinge_axis(hinge.wall.axis, hinge.parameters),
                        e = edge_direction(hinge.wall.axis), a0 = (e - e.dot(c0) * c0).normalized();
  const Eigen::Vector3d a = (lower * a0 + upper * a0).normalized(),
                        c = (lower * c0 + upper * c0).normalized();
  const double along_a = gap.dot(a), along_c = gap.dot(c);
  return 0.5 * (k.ratios.shear * gap.squaredNorm() + (k.ratios.axial - k.ratios.shear) * along_a * along_a +
                (k.ratios.along - k.ratios.shear) * along_c * along_c);
}

TEST(HingeEnergy, IsThatOfTwoPointSpringsAndATurningSpring) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const Stiffness& stiff = kinds[trial % 4];  // the others have no springs at two points
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
        springs +=
            spring_energy(stiff, (carried(hinge.lower, side) - carried(hinge.upper, side)) / s.size.edge_mm,
                          state[hinge.lower].R, state[hinge.upper].R, hinge);
      const double turn = hinge_turn(s, state, static_cast<int>(&hinge - s.hinges.data()));
      const double expected = springs + 0.5 * stiff.turn * turn * turn;
      EXPECT_NEAR(element_of(s, state, hinge, stiff).energy, expected, 1e-13 * (1 + expected));
      EXPECT_NEAR(
          hinge_energy(rest_hinge(hinge), stiff, state[hinge.lower], state[hinge.upper], s.size.edge_mm)
              .total(),
          expected, 1e-13 * (1 + expected));
    }
  }
}

TEST(HingeEnergy, GradientAndHessianMatchCentralDifferences) {
  std::mt19937 random(3);  // no hinge of these at the edge of its play, where the Hessian jumps
  for (int trial = 0; trial < 40; ++trial) {
    SCOPED_TRACE(trial);
    const Stiffness& stiff = kinds[trial % kinds.size()];
    const Structure s = with_offsets(random_panel(1, 1, random));
    const Linkage linkage = s;
    const State state = shaken(linkage, rest_state(linkage), 0.5, random);
    for (const Hinge& hinge : s.hinges) {
      const auto energy = [&](const Vector12& x) {
        return element_of(s, moved_pair(linkage, state, hinge, x), hinge, stiff).energy;
      };
      const Element e = element_of(s, state, hinge, stiff);
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
  for (int trial = 0; trial < 40; ++trial) {
    const Stiffness& stiff = kinds[trial % kinds.size()];
    const Structure s = with_offsets(random_panel(1, 1, random));
    const State state = shaken(s, rest_state(s), 0.5, random);
    for (const Hinge& hinge : s.hinges) {
      const auto energy_and_gradient = [&](const Eigen::VectorXd& q) -> Eigen::VectorXd {
        const RestHinge h = redesigned(hinge, q);
        const Stiffness k{
            .turn = stiff.turn + q[4],
            .reach = stiff.reach + q[5],
            .ratios = {stiff.ratios.axial + q[6], stiff.ratios.shear + q[7], stiff.ratios.along + q[8]},
            .tilt = {plus(stiff.tilt.rock, q[9]), plus(stiff.tilt.twist, q[10])},
            .play = stiff.play};
        const Element e = hinge_element(h, k, state[h.lower], state[h.upper], s.size.edge_mm);
        return (Eigen::VectorXd(13) << e.energy, e.gradient).finished();
      };
      Eigen::Matrix<double, 13, 11> all;
      for (int k = 0; k < 12; ++k) {
        const auto [energy, along] = hinge_gradients(rest_hinge(hinge), stiff, state[hinge.lower],
                                                     state[hinge.upper], s.size.edge_mm, Vector12::Unit(k));
        const auto row = [](const HingeGradient& r) {
          Eigen::Matrix<double, 1, 11> all_of_it;
          all_of_it << r.design.transpose(), r.turn, r.reach, r.ratios.axial, r.ratios.shear, r.ratios.along,
              r.rock, r.twist;
          return all_of_it;
        };
        all.row(0) = row(energy);
        all.row(1 + k) = row(along);
      }
      if (stiff.reach == 0)
        continue;  // its derivatives by design hold; a reach below 0 has no energy to compare
      expect_jacobian(energy_and_gradient, Eigen::VectorXd::Zero(11), all);
    }
  }
}

/// Returns the energy of one hinge of a flat cell with its upper body moved, without its turning spring. The wall runs
/// along x, its axis along z.
double energy_of_moved(const Stiffness& k, const Eigen::Vector3d& shift, const Eigen::Vector3d& turn) {
  const Structure s = make_structure(rectangle(1, 1), {});
  const RestHinge h = rest_hinge(s.hinges[*s.hinge_at({{0, 0}, Axis::x})]);
  State state = rest_state(s);
  Pose& upper = state[h.upper];
  if (turn.norm() > 0) upper.R = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  upper.p += s.size.edge_mm * (shift + h.upper_arm - upper.R * h.upper_arm);
  return hinge_energy(h, k, state[h.lower], upper, s.size.edge_mm).stretch;
}

TEST(HingeEnergy, RocksAndTwistsByStiffnessesOfItsOwn) {
  const Stiffness k{.reach = 0.4, .ratios = {1, 0.3, 0.5}, .tilt = {0.5, 0.2}};
  const double turn = 1e-3;  // rad: the sine's error is a millionth
  using Eigen::Vector3d;
  EXPECT_NEAR(energy_of_moved(k, Vector3d::Zero(), turn * Vector3d::UnitY()), 0.25 * turn * turn, 1e-12);
  EXPECT_NEAR(energy_of_moved(k, Vector3d::Zero(), turn * Vector3d::UnitX()), 0.1 * turn * turn, 1e-12);
  const Stiffness by_reach{.reach = 0.4, .ratios = {1, 0.3, 0.5}},
      given{.reach = 0.4, .ratios = {1, 0.3, 0.5}, .tilt = {2 * 0.16, 2 * 0.16 * 0.3}};
  const Vector3d any(0.01, -0.02, 0.03), about(0.2, 0.3, -0.1);
  EXPECT_NEAR(energy_of_moved(given, any, about), energy_of_moved(by_reach, any, about), 1e-16);
}

TEST(HingeEnergy, OfAPinWithPlayBeginsBeyondIt) {
  const Stiffness k{.reach = 0.4, .ratios = {0.8, 0.8, 0.5}, .play = 0.02};
  const double loose = loose_stiffness * 0.8;
  using Eigen::Vector3d;
  for (const Vector3d& way : {Vector3d(1, 0, 0), Vector3d(0.6, -0.8, 0), Vector3d(0, 1, 0)}) {
    EXPECT_LE(energy_of_moved(k, 0.018 * way, Vector3d::Zero()), loose * 0.02 * 0.02);
    EXPECT_NEAR(energy_of_moved(k, 0.05 * way, Vector3d::Zero()), 0.8 * (0.03 * 0.03 + 2e-3 * 2e-3 / 12),
                loose * 0.05 * 0.05 + 1e-15);
  }
  EXPECT_NEAR(energy_of_moved(k, 0.05 * Vector3d::UnitZ(), Vector3d::Zero()),
              0.5 * (0.03 * 0.03 + 2e-3 * 2e-3 / 12), loose * 0.05 * 0.05 + 1e-15);
  // Two points tilt freely by asin(play / reach). Beyond that, their reach resists.
  const double free = std::asin(0.9 * 0.02 / 0.4), held = std::asin(0.05 / 0.4);
  EXPECT_LE(energy_of_moved(k, Vector3d::Zero(), free * Vector3d::UnitX()), loose * 0.02 * 0.02);
  EXPECT_GT(energy_of_moved(k, Vector3d::Zero(), held * Vector3d::UnitX()), 0.7 * 0.03 * 0.03);
}

TEST(HingeEnergy, PlayHasARoundedCornerWithContinuousForceAndStiffness) {
  for (const double play : {1e-3, 0.02, 0.3})
    for (int k = 0; k <= 400; ++k) {
      const double d = k / 201.0 * play;  // never at a corner
      const ClearanceResponse r = clearance_response(d, play);
      testing::expect_jacobian(
          [&](const Eigen::VectorXd& x) {
            const ClearanceResponse at = clearance_response(d + play * x[0], play);
            return Eigen::Vector2d(at.energy / (play * play), at.force / play);
          },
          Eigen::VectorXd::Zero(1), Eigen::Vector2d(r.force / play, r.stiffness), 1e-4, 1e-5);
    }
}

TEST(HingeEnergy, OfAFrameWithEqualStiffnessesIsThatOfTwoSpringsTimesAsStiff) {
  std::mt19937 random(6);
  const Stiffness once{.turn = 1e-9, .reach = 0.4}, thrice{.turn = 3e-9, .reach = 0.4, .ratios = {3, 3, 3}};
  const Structure s = with_offsets(random_panel(1, 1, random));
  const State state = shaken(s, rest_state(s), 0.5, random);
  for (const Hinge& hinge : s.hinges) {
    const Element a = element_of(s, state, hinge, once), b = element_of(s, state, hinge, thrice);
    EXPECT_NEAR(b.energy, 3 * a.energy, 1e-14);
    EXPECT_LE((b.hessian - 3 * a.hessian).norm(), 1e-13);
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
        const TurnGradients derivatives =
            turn_gradients(rest_hinge(hinge), state[hinge.lower], state[hinge.upper], Vector12::Unit(k));
        all.row(0) = derivatives.turn.transpose();
        all.row(1 + k) = derivatives.along.transpose();
      }
      expect_jacobian(turn_and_gradient, Eigen::VectorXd::Zero(4), all);
    }
  }
}

}  // namespace
}  // namespace kinetix::model
