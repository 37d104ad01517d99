#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "model/hinge/hinge_energy.hpp"
#include "sim/joints/elastic_hinges.hpp"
#include "tests/support/random_elastic.hpp"

namespace kinetix::sim {
namespace {

using Eigen::Vector3d;

// Ratios over 2 k_point: a block, a pin that slides on its rod, and a hinge that is equal in all directions.
const std::vector<model::PointRatios> kinds{{1, 0.3, 0.5}, {0.9, 1, 0.2}, {0.4, 0.4, 0.4}};
constexpr double step_s = 1e-3;  // s: any will do, forces do not depend on it

/// Returns the forces and moments of a hinge's two points on its two bodies, from rest, ordered as twists in
/// model::Element.
model::Vector12 pull_of(const model::RestHinge& hinge, const model::Stiffness& k, double edge_mm,
                        const model::State& state) {
  std::vector<VelocityRow> rows;
  append_framed_points(hinge, k, edge_mm, state, std::vector<model::Twist>(state.size()), step_s, rows);
  model::Vector12 sum = model::Vector12::Zero();
  for (const VelocityRow& row : rows) {
    EXPECT_EQ(row.a, hinge.lower);
    EXPECT_EQ(row.b, hinge.upper);
    const double force = row.weight * row.target * step_s;
    sum.segment<3>(0) += force * row.first.tail<3>();
    sum.segment<3>(3) += force * row.first.head<3>();
    sum.segment<3>(6) += force * row.second.tail<3>();
    sum.segment<3>(9) += force * row.second.head<3>();
  }
  return sum;
}

TEST(FramedPoints, PullAsTheEnergyOfTheEquilibriumModelFalls) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const model::Structure s = testing::random_panel(1, 1, random);
    const model::State state = testing::shaken(s, model::rest_state(s), 0.5, random);
    for (const model::PointRatios& ratios : kinds)
      for (const model::Hinge& hinge : s.hinges) {
        const model::RestHinge h = rest_hinge(hinge);
        const model::Stiffness k{.turn = 1e-14, .reach = 0.4, .ratios = ratios};
        const model::Vector12 fall = -hinge_gradient(h, k, state[h.lower], state[h.upper], s.size.edge_mm);
        EXPECT_LE((pull_of(h, k, s.size.edge_mm, state) - fall).norm(), 1e-12 * (1 + fall.norm()));
      }
  }
}

TEST(FramedPoints, OfTiltsOfTheirOwnAndOfPinsWithPlayPullAsTheEnergyFallsToo) {
  std::mt19937 random(2);
  const std::vector<model::Stiffness> stiff{
      {.turn = 1e-14, .reach = 0.4, .tilt = {0.5, 0.2}},
      {.turn = 1e-14, .reach = 0.4, .ratios = {1, 0.3, 0.5}, .tilt = {0.1, {}}},
      {.turn = 1e-14, .reach = 0.4, .ratios = {0.8, 0.8, 0.5}, .play = 0.1},
      {.turn = 1e-14, .reach = 0.4, .play = 0.01}};
  for (int trial = 0; trial < 20; ++trial) {
    const model::Structure s = testing::random_panel(1, 1, random);
    const model::State state = testing::shaken(s, model::rest_state(s), 0.5, random);
    for (const model::Stiffness& k : stiff)
      for (const model::Hinge& hinge : s.hinges) {
        const model::RestHinge h = rest_hinge(hinge);
        const model::Vector12 fall = -hinge_gradient(h, k, state[h.lower], state[h.upper], s.size.edge_mm);
        EXPECT_LE((pull_of(h, k, s.size.edge_mm, state) - fall).norm(), 1e-11 * (1 + fall.norm()));
        const HingePull pull = hinge_pull(h, k, state[h.lower], state[h.upper], s.size.edge_mm);
        EXPECT_LE((pull.point + fall.segment<3>(3)).norm(), 1e-11 * (1 + fall.norm()));
      }
  }
}

/// Two bodies that are moved apart by g pull each other with 2 k g, and tilted by a small angle about the wall
/// or across it with 2 k reach^2 sin(angle): of two springs k.
TEST(FramedPoints, PullTwoBodiesByTheStiffnessOfEachDirection) {
  const model::Structure s = make_structure(model::rectangle(1, 1), {});
  const model::RestHinge h = rest_hinge(s.hinges[*s.hinge_at({{0, 0}, model::Axis::x})]);
  const double edge = s.size.edge_mm, gap = 0.01;
  for (const model::PointRatios& r : kinds) {
    const model::Stiffness k{.reach = 0.3, .ratios = r};
    const Vector3d by_direction(r.axial, r.shear, r.along);  // the wall runs along x, its axis stands along z
    for (int d = 0; d < 3; ++d) {
      model::State state = model::rest_state(s);
      state[h.upper].p += gap * edge * Vector3d::Unit(d);
      const model::Vector12 pull = pull_of(h, k, edge, state);
      EXPECT_LE((pull.segment<3>(3) - 2 * by_direction[d] * gap * Vector3d::Unit(d)).norm(), 1e-14);
      EXPECT_LE((pull.segment<3>(9) + pull.segment<3>(3)).norm(), 1e-14);
    }
    for (const auto& [d, stiffness] : {std::pair{0, r.shear}, std::pair{1, r.axial}}) {
      model::State state = model::rest_state(s);
      const Eigen::Matrix3d tilt = Eigen::AngleAxisd(0.02, Vector3d::Unit(d)).toRotationMatrix();
      state[h.upper].R = tilt;
      state[h.upper].p += edge * (h.upper_arm - tilt * h.upper_arm);  // about the hinge point
      const model::Vector12 pull = pull_of(h, k, edge, state);
      EXPECT_NEAR(pull[6 + d], -2 * stiffness * 0.09 * std::sin(0.02), 1e-7);
    }
  }
}

}  // namespace
}  // namespace kinetix::sim
