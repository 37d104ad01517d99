#include "model/contact/swept_motion.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "model/lattice/lattice_motion.hpp"
#include "tests/support/random_designs.hpp"
#include "tests/support/random_nets.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

/// Returns point `r` of a body in the frame of the body `from`.
Vector3d seen(const State& state, int from, int body, const Vector3d& r) {
  return state[from].R.transpose() * (state[body].p + state[body].R * r - state[from].p);
}

SweptMotion motion_along(const Lattice& sheet, const HingeChain& chain, int from, double theta, double h) {
  const Linkage linkage = sheet;
  const State state = exact_motion(sheet).at(theta);
  const std::vector<TurnLaw> laws = turn_laws(sheet);
  SweptMotion motion(h);
  for (const ChainStep& step : chain) {
    const RestHinge& hinge = linkage.hinges[step.hinge];
    const Vector3d axis = state[from].R.transpose() * (state[hinge.lower].R * hinge.axis);
    const TurnLaw& law = laws[step.hinge];
    motion.pass(seen(state, from, hinge.lower, hinge.lower_arm * linkage.size.edge_mm), axis,
                step.sense * hinge_sense(linkage, step.hinge) * law.rate(theta),
                bounds_of(law, theta - h, theta + h));
  }
  return motion;
}

/// Compares twist and bounds between random bodies of a sheet with states of the closed form.
void expect_bounds(const Lattice& sheet, std::mt19937& random) {
  const Linkage linkage = sheet;
  const ExactMotion exact = exact_motion(sheet);
  HingeChains chains(linkage);
  std::uniform_int_distribution<int> any(0, static_cast<int>(linkage.bodies.size()) - 1);
  for (int k = 0; k < 20; ++k) {
    const int from = any(random), to = any(random);
    const HingeChain chain = chains.find(from, {to}).front();
    const double theta = 0.3, h = 0.05;
    const SweptMotion motion = motion_along(sheet, chain, from, theta, h);
    const Vector3d r = 5 * Vector3d::Random(), middle = seen(exact.at(theta), from, to, r);
    const double tau = 1e-5;
    const Vector3d speed =
        (seen(exact.at(theta + tau), from, to, r) - seen(exact.at(theta - tau), from, to, r)) / (2 * tau);
    EXPECT_LE((motion.speed(middle) - speed).norm(), 1e-6 * (1 + speed.norm()));
    for (int n = -20; n <= 20; ++n) {
      const double t = h * n / 20;
      const Vector3d there = seen(exact.at(theta + t), from, to, r);
      EXPECT_LE((there - middle - t * motion.speed(middle)).norm(),
                motion.change(middle, 0) * t * t / 2 + 1e-10);
      EXPECT_LE((there - middle).norm(), motion.travel(middle, 0) + 1e-10);
    }
  }
}

TEST(SweptMotion, BoundsThePathsOfAllFamilies) {
  std::mt19937 random(84);
  for (int k = 0; k < 5; ++k) {
    for (const Family family : {Family::F1, Family::F2, Family::F3})
      expect_bounds(testing::structure_of(testing::random_design(family, 5, 3, random)), random);
    expect_bounds(testing::random_net(20, random), random);
  }
  expect_bounds(make_sodalite({1, 1, 1}, 0.2, {10, 0.8, 3}), random);
}

TEST(SweptMotion, OfPlanarBodiesKnowsNoChangeOfTheirSpin) {
  SweptMotion motion(0.05);
  for (int k = 0; k < 40; ++k) motion.pass(Vector3d(k, 0, 0), Vector3d::UnitZ(), k % 2 == 0 ? -2 : 2, {2, 0});
  EXPECT_LE(motion.omega().norm(), 1e-12);
  EXPECT_NEAR(motion.change(Vector3d(39, 0, 0), 0), 20 * 4, 1e-9);
}

TEST(HingeChains, LeadFromBodyToBodyByAsFewHingesAsCanBe) {
  const Structure s = make_structure(rectangle(5, 4), {});
  HingeChains chains(s);
  std::vector<int> all;
  for (int b = 0; b < static_cast<int>(s.bodies.size()); ++b) all.push_back(b);
  for (const int from : {0, 7}) {
    const std::vector<HingeChain> found = chains.find(from, all);
    for (const int to : all) {
      const Vertex a = s.bodies[from], b = s.bodies[to];
      EXPECT_EQ(static_cast<int>(found[to].size()), std::abs(a.i - b.i) + std::abs(a.j - b.j));
      int at = from;
      for (const ChainStep& step : found[to]) {
        const Hinge& hinge = s.hinges[step.hinge];
        EXPECT_EQ(at, step.sense > 0 ? hinge.lower : hinge.upper);
        at = step.sense > 0 ? hinge.upper : hinge.lower;
      }
      EXPECT_EQ(at, to);
    }
  }
  EXPECT_EQ(chains.tree(3).size(), all.size() - 1);
}

}  // namespace
}  // namespace kinetix::model
