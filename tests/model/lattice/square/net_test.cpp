#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "model/lattice/square/family/classification.hpp"
#include "model/lattice/square/family/net.hpp"
#include "tests/support/derivatives.hpp"
#include "tests/support/random_designs.hpp"
#include "tests/support/random_nets.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::cube_net;
using testing::random_net;

TEST(Net, ClosesEveryHingeOfRandomNetsAtAnyTheta) {
  constexpr unsigned seed = 11;
  std::mt19937 random(seed);
  int bending = 0;
  for (int k = 0; k < 120; ++k) {
    const Structure net = random_net(5 + k, random);
    bending += !all_vertical(net);
    const NetTree tree = make_net_tree(net);
    for (const double theta : {-1.2, -0.3, 1e-6, 0.4, 0.78, 1.5}) {
      const HingeGaps gaps = hinge_gaps(net, fold_net(tree, net, theta));
      EXPECT_LE(gaps.max, 1e-12) << "seed " << seed << ", net " << k;
      EXPECT_LE(gaps.axis_max, 1e-12) << "seed " << seed << ", net " << k;
    }
  }
  EXPECT_GE(bending, 60) << "seed " << seed;
}

TEST(Net, FoldsASheetAsTheReflectionsOfItsFamilyDo) {
  constexpr unsigned seed = 5;
  std::mt19937 random(seed);
  for (const Family family : {Family::F1, Family::F2}) {
    const auto design = testing::random_design(family, 7, 4, random);
    const Structure sheet = testing::structure_of(design);
    const StateDistance apart =
        aligned_distance(sheet, fold_net(make_net_tree(sheet, 9), sheet, design.theta), fold(design, sheet));
    EXPECT_LE(apart.max, 1e-13) << to_string(family) << ", seed " << seed;
  }
}

TEST(Net, IsTheSameFromAnyRoot) {
  std::mt19937 random(3);
  const Structure net = random_net(60, random);
  const State from_first = fold_net(make_net_tree(net), net, 0.6);
  for (const int root : {7, 20, 40})
    EXPECT_LE(aligned_distance(net, fold_net(make_net_tree(net, root), net, 0.6), from_first).max, 1e-12);
}

TEST(Net, LinksBehindALinkFollowIt) {
  std::mt19937 random(4);
  const Structure net = random_net(50, random);
  const NetTree tree = make_net_tree(net, 11);
  ASSERT_EQ(tree.links.size() + 1, net.bodies.size());
  std::vector<int> link_of(net.bodies.size(), -1);
  for (std::size_t k = 0; k < tree.links.size(); ++k) {
    const NetTree::Link& link = tree.links[k];
    const int above = link_of[link.parent];
    EXPECT_TRUE(link.parent == tree.root || above >= 0);
    EXPECT_LE(link.end, above >= 0 ? tree.links[above].end : static_cast<int>(tree.links.size()));
    EXPECT_GT(link.end, static_cast<int>(k));
    link_of[link.body] = static_cast<int>(k);
  }
}

/// Orientation columns and position of every body, one under the other.
VectorXd as_vector(const State& state) {
  VectorXd out(12 * static_cast<Eigen::Index>(state.size()));
  for (std::size_t b = 0; b < state.size(); ++b) {
    for (int k = 0; k < 3; ++k) out.segment<3>(12 * b + 3 * k) = state[b].R.col(k);
    out.segment<3>(12 * b + 9) = state[b].p;
  }
  return out;
}

VectorXd derivatives(const State& state, const std::vector<Twist>& twists) {
  VectorXd out(12 * static_cast<Eigen::Index>(state.size()));
  for (std::size_t b = 0; b < state.size(); ++b) {
    for (int k = 0; k < 3; ++k) out.segment<3>(12 * b + 3 * k) = twists[b].omega.cross(state[b].R.col(k));
    out.segment<3>(12 * b + 9) = twists[b].v;
  }
  return out;
}

TEST(Net, RatesAgreeWithCentralDifferences) {
  constexpr unsigned seed = 21;
  std::mt19937 random(seed);
  for (int k = 0; k < 20; ++k) {
    Structure net = random_net(10 + 2 * k, random);
    const NetTree tree = make_net_tree(net, k);
    const Creases creases = find_creases(net);
    std::vector<int> bending;
    for (std::size_t c = 0; c < creases.list.size(); ++c)
      if (net.hinges[creases.list[c].hinges[0]].parameters.beta != 0) bending.push_back(static_cast<int>(c));
    VectorXd x(bending.size() + 1);
    for (std::size_t c = 0; c < bending.size(); ++c) {
      const Hinge& first = net.hinges[creases.list[bending[c]].hinges[0]];
      x[c] = alternation(first.wall) * first.parameters.beta;
    }
    x[x.size() - 1] = 0.5;
    const auto state = [&](const VectorXd& at) {
      for (std::size_t c = 0; c < bending.size(); ++c) set_tilt(net, creases.list[bending[c]], at[c]);
      return as_vector(fold_net(tree, net, at[at.size() - 1]));
    };
    state(x);
    const NetMotion motion = fold_net_with_jacobian(tree, net, x[x.size() - 1]);
    Eigen::MatrixXd analytic(12 * net.bodies.size(), x.size());
    for (std::size_t c = 0; c < bending.size(); ++c)
      analytic.col(c) =
          derivatives(motion.state, twists_by_tilt(tree, net, motion, x[x.size() - 1], bending[c]));
    analytic.col(x.size() - 1) = derivatives(motion.state, motion.by_theta);
    testing::expect_jacobian(state, x, analytic);
  }
}

TEST(Net, FoldsTheCubeOfThePaperAt45Degrees) {
  const Structure net = cube_net(std::atan(std::sqrt(2.0)));
  EXPECT_EQ(net.bodies.size(), 54u);
  EXPECT_EQ(net.hinges.size(), 87u);
  const Classification kind = classify(net);
  ASSERT_EQ(kind.family, Family::F4) << kind.why;
  const State state = fold(kind, net, pi / 4);
  EXPECT_LE(hinge_gaps(net, state).max, 1e-13);
  const auto normal = [&](int i, int j) -> Vector3d { return state[*net.body_at({i, j})].R.col(2); };
  const Vector3d base = normal(4, 4);
  for (const auto& [i, j] : {std::pair{1, 4}, {7, 4}, {4, 1}, {4, 7}})
    EXPECT_NEAR(base.dot(normal(i, j)), 0, 1e-12);
  EXPECT_NEAR(base.dot(normal(4, 10)), -1, 1e-12);
  EXPECT_NEAR(normal(1, 4).dot(normal(7, 4)), -1, 1e-12);
  // Opposite faces of 3 x 3 bodies lie 3 pitches apart, each vertex over its like.
  const Vector3d below = state[*net.body_at({4, 10})].p - state[*net.body_at({4, 4})].p;
  EXPECT_NEAR((below + 3 * 10 * std::cos(pi / 4) * base).norm(), 0, 1e-11);
}

TEST(NetRules, RefuseCreasesThatCross) {
  Structure sheet = make_structure(rectangle(3, 3), {});
  const Creases creases = find_creases(sheet);
  set_tilt(sheet, creases.list[creases.of_hinge[*sheet.hinge_at({{1, 0}, Axis::x})]], 0.4);
  EXPECT_EQ(check_net(sheet).broken, 0u);
  set_tilt(sheet, creases.list[creases.of_hinge[*sheet.hinge_at({{0, 1}, Axis::y})]], 0.4);
  const NetCheck check = check_net(sheet);
  EXPECT_GT(check.broken, 0u);
  EXPECT_EQ(
      check.rule,
      "a crease cannot cross another that bends where four cells meet, unless their two columns or their two "
      "rows have one tilt");
  EXPECT_EQ(classify(sheet).family, Family::none);
}

TEST(NetRules, RefuseARingWithCreasesBothWays) {
  std::vector<Cell> ring;
  for (const Cell& cell : rectangle(5, 5))
    if (!(cell.i > 0 && cell.i < 4 && cell.j > 0 && cell.j < 4)) ring.push_back(cell);
  Structure net = make_structure(std::move(ring), {});
  const Creases creases = find_creases(net);
  const auto crease = [&](const Wall& wall) { return creases.list[creases.of_hinge[*net.hinge_at(wall)]]; };
  set_tilt(net, crease({{2, 0}, Axis::x}), 0.3);
  set_tilt(net, crease({{2, 4}, Axis::x}), 0.3);
  EXPECT_EQ(check_net(net).broken, 0u);
  set_tilt(net, crease({{0, 2}, Axis::y}), 0.3);
  set_tilt(net, crease({{4, 2}, Axis::y}), 0.3);
  EXPECT_EQ(check_net(net).rule,
            "creases around a hole must let it close: equal if they are in line, and not crossing in it");
}

TEST(NetRules, RefuseDifferentTiltsInLineAroundAHole) {
  std::vector<Cell> ring = rectangle(3, 3);
  std::erase(ring, Cell{1, 1});
  Structure net = make_structure(std::move(ring), {});
  const Creases creases = find_creases(net);
  const auto crease = [&](const Wall& wall) { return creases.list[creases.of_hinge[*net.hinge_at(wall)]]; };
  set_tilt(net, crease({{1, 0}, Axis::x}), 0.3);
  EXPECT_GT(check_net(net).broken, 0u);
  set_tilt(net, crease({{1, 3}, Axis::x}), 0.3);
  EXPECT_EQ(check_net(net).broken, 0u);
}

TEST(NetRules, NameTheHingeWhoseTiltIsOff) {
  Structure net = cube_net(0.7);
  const int odd = *net.hinge_at({{3, 9}, Axis::y});
  net.hinges[odd].parameters.beta = 0.01;
  const NetCheck check = check_net(net);
  EXPECT_EQ(check.broken, 1u);
  EXPECT_EQ(check.breaking_hinge, odd);
}

}  // namespace
}  // namespace kinetix::model
