#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "model/lattice/lattice_motion.hpp"
#include "model/linkage/exact_motion.hpp"
#include "tests/support/creased.hpp"
#include "tests/support/miura.hpp"
#include "tests/support/random_designs.hpp"
#include "tests/support/random_nets.hpp"

namespace kinetix::model {
namespace {

using testing::random_design;
using testing::structure_of;

TurnLaw random_law(std::mt19937& random) {
  std::uniform_real_distribution<double> p(0.2, 2), q(-2, 2);
  return {p(random), q(random)};
}

TEST(TurnLaw, OfAnUprightHingeIsTwiceTheta) {
  for (const double theta : {-1.2, 0.0, 0.3, 1.5}) {
    EXPECT_NEAR(TurnLaw{}.turn(theta), 2 * theta, 1e-15);
    EXPECT_NEAR(TurnLaw{}.rate(theta), 2, 1e-14);
  }
  EXPECT_NEAR(bounds_of({}, -1, 1).rate, 2, 1e-11);
  EXPECT_NEAR(bounds_of({}, -1, 1).change, 0, 1e-11);
}

TEST(TurnLaw, RateIsTheDerivativeOfTheTurn) {
  std::mt19937 random(81);
  std::uniform_real_distribution<double> angle(-1.5, 1.5);
  for (int k = 0; k < 200; ++k) {
    const TurnLaw law = random_law(random);
    const double theta = k == 0 ? 0 : angle(random), h = 1e-5;
    EXPECT_NEAR(law.rate(theta), (law.turn(theta + h) - law.turn(theta - h)) / (2 * h), 1e-6) << "seed 81";
  }
}

TEST(TurnLaw, BoundsHoldOverTheirIntervalAndAreReached) {
  std::mt19937 random(82);
  std::uniform_real_distribution<double> angle(-1.5, 1.5), width(0, 0.5);
  for (int k = 0; k < 200; ++k) {
    const TurnLaw law = random_law(random);
    const double low = angle(random), high = low + width(random);
    const RateBounds bounds = bounds_of(law, low, high);
    double fastest = 0, steepest = 0;
    for (int n = 0; n <= 400; ++n) {
      const double theta = low + (high - low) * n / 400, h = 1e-5;
      fastest = std::max(fastest, law.rate(theta));
      steepest = std::max(steepest, std::abs(law.rate(theta + h) - law.rate(theta - h)) / (2 * h));
    }
    EXPECT_GE(bounds.rate, fastest) << "seed 82";
    EXPECT_LE(bounds.rate, fastest * (1 + 1e-3)) << "seed 82";
    EXPECT_GE(bounds.change, steepest - 1e-4) << "seed 82";
  }
}

/// Returns how far the turns of a sheet's hinges differ from the laws, rad.
double off_the_laws(const Lattice& sheet) {
  const Linkage linkage = sheet;
  const ExactMotion exact = exact_motion(sheet);
  const std::vector<TurnLaw> laws = turn_laws(sheet);
  double off = exact ? 0 : 1;
  for (const double theta : {-0.9, -0.3, 0.01, 0.2, 0.7})
    for (std::size_t h = 0; exact && h < laws.size(); ++h) {
      const State state = exact.at(theta);
      const RestHinge& hinge = linkage.hinges[h];
      const Eigen::AngleAxisd turn(hinge_sense(linkage, static_cast<int>(h)) * laws[h].turn(theta),
                                   hinge.axis);
      off = std::max(off, (state[hinge.lower].R * turn.toRotationMatrix() - state[hinge.upper].R).norm());
    }
  return off;
}

Structure transposed_sheet(std::mt19937& random) {
  const Structure s = structure_of(random_design(Family::F3, 3, 4, random));
  Structure out = make_structure(rectangle(4, 3), s.size);
  for (const Hinge& hinge : s.hinges) {
    const Wall& wall = hinge.wall;
    const Wall swapped{{wall.from.j, wall.from.i}, wall.axis == Axis::x ? Axis::y : Axis::x};
    HingeParameters& p = out.hinges[*out.hinge_at(swapped)].parameters;
    p = hinge.parameters;
    p.beta = -p.beta;
  }
  return out;
}

TEST(TurnLaws, AreThoseOfTheStatesOfEveryFamilyOfSquares) {
  std::mt19937 random(83);
  for (int k = 0; k < 10; ++k) {
    for (const Family family : {Family::F1, Family::F2, Family::F3})
      EXPECT_LE(off_the_laws(structure_of(random_design(family, 4, 3, random))), 1e-9)
          << to_string(family) << " seed 83";
    EXPECT_LE(off_the_laws(transposed_sheet(random)), 1e-9) << "seed 83";
    EXPECT_LE(off_the_laws(testing::random_net(30, random)), 1e-9) << "seed 83";
  }
}

TEST(TurnLaws, AreThoseOfTheStatesOfOtherLattices) {
  EXPECT_LE(off_the_laws(testing::creased_rhombi(5, 4, 1.2)), 1e-9);
  EXPECT_LE(off_the_laws(testing::creased_quads(6, 3)), 1e-9);
  EXPECT_LE(off_the_laws(testing::miura_of_hexagons(3, 3, 1.05, 0.8)), 1e-9);
  EXPECT_LE(off_the_laws(make_sodalite({1, 2, 1}, 0.2, {10, 0.8, 3})), 1e-9);
}

}  // namespace
}  // namespace kinetix::model
