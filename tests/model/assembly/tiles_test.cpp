#include "model/assembly/tiles.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/assembly/assembly_motion.hpp"
#include "model/base/invalid_input.hpp"
#include "model/closure/closure.hpp"
#include "model/linkage/state.hpp"
#include "tests/support/rotating_squares.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;
using testing::rotating_squares;

constexpr double quarter = 0.7853981633974483;  // rad: half a right angle, where squares are furthest apart

TileMake thin() { return {.scale_mm = 10, .thickness_mm = 0.5, .kerf_mm = 0.3}; }

std::string refused_tiles(const TileSheet& sheet, const TileMake& make = thin()) {
  try {
    assembly_of_tiles(sheet, make);
  } catch (const InvalidInput& e) {
    return e.what();
  }
  return "taken";
}

TEST(Tiles, AreThePrismsThatCutsLeave) {
  const Assembly a = assembly_of_tiles(rotating_squares(2, 2, 0.3), thin());
  ASSERT_EQ(a.bodies.size(), 4u);
  for (const AssemblyBody& body : a.bodies) EXPECT_NEAR(volume_mm3(body.solid), 9.7 * 9.7 * 0.5, 1e-9);
  EXPECT_NEAR(a.edge_mm, 10, 1e-12);
  ASSERT_EQ(a.hinges.size(), 4u);
  for (const AssemblyHinge& h : a.hinges) {
    EXPECT_FALSE(h.ball);
    EXPECT_LT(h.lower, h.upper);
    EXPECT_NEAR(std::abs(h.axis.z()), 1, 1e-12);
  }
}

TEST(Tiles, TurnEveryWayAboutABallAndOneWayAboutAHinge) {
  TileSheet pair = rotating_squares(2, 1, 0.3);
  const auto motions = [&] {
    const Linkage linkage = linkage_of(assembly_of_tiles(pair, thin()));
    return degrees_of_freedom(linkage, rest_state(linkage), linkage.hinges.size(), 1e-6);
  };
  EXPECT_EQ(motions(), 1);
  pair.joints[0].both_faces = false;
  EXPECT_EQ(motions(), 3);
  pair.joints[0].both_faces = true;  // the tiles are at a right angle, so no normal belongs to both
  for (Vector3d& c : pair.tiles[1]) c = {0.5, c.y(), c.x() - 0.5};
  EXPECT_EQ(motions(), 3);
}

TEST(Tiles, OfTheSquaresFollowTheirClosedForm) {
  for (const double turn : {quarter, -0.4, 1.2}) {
    const TileSheet sheet = rotating_squares(7, 5, turn);
    const Assembly assembly = assembly_of_tiles(sheet, thin());
    const Linkage linkage = linkage_of(assembly);
    const TileTarget target = target_of_tiles(sheet, assembly, thin().scale_mm);
    EXPECT_LT(target.off_max, 1e-12);
    // Below 0, squares would first have to pass through each other. The equations allow that.
    const Deployment way = deploy(linkage, aligned_pull(linkage, {target.poses}));
    ASSERT_TRUE(way.reached) << turn;
    EXPECT_LT(way.off_max, 1e-8);
    EXPECT_LT(way.gap, 1e-9);
    EXPECT_NEAR(mean_half_turn(linkage, way.states.back()), std::abs(turn), 1e-8);
    for (const State& state : way.states) {
      const double phi = 0.5 * std::atan2(state[0].R.col(0).cross(state[1].R.col(0)).z(),
                                          state[0].R.col(0).dot(state[1].R.col(0)));
      EXPECT_NEAR((state[1].p - state[0].p).norm(), 10 * (std::cos(phi) - std::sin(phi)), 1e-7);
    }
  }
}

TEST(Tiles, PulledApartGoAsFarAsSquaresGo) {
  const TileSheet sheet = rotating_squares(6, 6, quarter);
  const Linkage linkage = linkage_of(assembly_of_tiles(sheet, thin()));
  Pull apart{rest_state(linkage), false};
  for (Pose& pose : apart.to) pose.p = 3 * (pose.p - Vector3d(25, 25, 0)) + Vector3d(25, 25, 0);
  const Deployment way = deploy(linkage, apart);
  ASSERT_TRUE(way.reached);
  const State& last = way.states.back();
  const double farthest = 10 * std::sqrt(2.0);
  EXPECT_NEAR((last[1].p - last[0].p).norm(), farthest, 1e-3 * farthest);
  EXPECT_NEAR(mean_half_turn(linkage, last), quarter, 0.05) << "a maximum: a thousandth of it is a long way";
}

/// Returns the slope of the squared distance to the pull along motions that keep the hinges closed. It vanishes at the
/// nearest closed state, since the gradient then has no part in the null space of closure.
double slope_along_motions(const Linkage& linkage, const Pull& pull, const State& state) {
  const auto off = [&](const State& at) {
    double sum = 0;
    for (std::size_t b = 0; b < at.size(); ++b)
      for (const Vector3d& arm : pull_points(pull.turns))
        sum +=
            ((at[b].p - pull.to[b].p) / linkage.size.edge_mm + (at[b].R - pull.to[b].R) * arm).squaredNorm();
    return sum / static_cast<double>(pull_points(pull.turns).size());
  };
  const Eigen::Index n = 6 * static_cast<Eigen::Index>(state.size());
  Eigen::VectorXd gradient(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::VectorXd step = 1e-5 * Eigen::VectorXd::Unit(n, k);
    gradient[k] =
        (off(retract_straight(linkage, state, step)) - off(retract_straight(linkage, state, -step))) / 2e-5;
  }
  const Eigen::MatrixXd J = closure_jacobian(linkage, state);
  const Eigen::MatrixXd motions = Eigen::FullPivLU<Eigen::MatrixXd>(J).kernel();
  return (motions.transpose() * gradient).norm() / gradient.norm();
}

TEST(Tiles, ThatCannotReachTheirTargetEndWhereNoMotionBringsThemNearer) {
  for (const bool ball : {false, true}) {
    TileSheet sheet = rotating_squares(4, 3, 0.6);
    for (TileJoint& joint : sheet.joints) joint.both_faces = !ball;
    for (auto& tile : sheet.target)
      for (Vector3d& c : tile) c.z() = ball ? 0.05 * c.x() * c.x() : 0;
    for (Vector3d& c : sheet.target[5]) c += Vector3d(0.3, -0.2, ball ? 0.4 : 0);
    const Assembly assembly = assembly_of_tiles(sheet, thin());
    const Linkage linkage = linkage_of(assembly);
    const Pull pull = aligned_pull(linkage, {target_of_tiles(sheet, assembly, thin().scale_mm).poses});
    const Deployment way = deploy(linkage, pull);
    ASSERT_TRUE(way.reached) << ball;
    EXPECT_GT(way.off_max, 0.05);
    EXPECT_LT(slope_along_motions(linkage, pull, way.states.back()), 1e-5) << ball;
  }
}

TEST(Tiles, RefuseWhatCannotBe) {
  TileSheet sheet = rotating_squares(3, 1, 0.3);
  sheet.tiles[1][2] = sheet.tiles[1][0];
  EXPECT_THAT(refused_tiles(sheet), HasSubstr("tile 2 has no area"));
  sheet = rotating_squares(3, 1, 0.3);
  sheet.tiles[2][1].z() = 0.4;
  EXPECT_THAT(refused_tiles(sheet), HasSubstr("tile 3 is not flat"));
  sheet = rotating_squares(3, 1, 0.3);
  sheet.tiles[0][2] = {-0.4, -0.4, 0};
  EXPECT_THAT(refused_tiles(sheet), HasSubstr("tile 1 is not convex at corner 3"));
  sheet = rotating_squares(3, 1, 0.3);
  EXPECT_THAT(refused_tiles(sheet, {.scale_mm = 10, .thickness_mm = 1, .kerf_mm = 11}),
              HasSubstr("tile 1 is narrower than the cuts, 11 mm"));
  sheet.joints[1].second = 7;
  EXPECT_THAT(refused_tiles(sheet), HasSubstr("joint 2: the file has no tile 7. Give 0 to 2"));
  sheet = rotating_squares(3, 1, 0.3);
  sheet.joints[0].first_corner = 4;
  EXPECT_THAT(refused_tiles(sheet), HasSubstr("joint 1: tile 0 has no corner 4"));
  sheet.joints[0].first_corner = 3;
  EXPECT_THAT(refused_tiles(sheet), HasSubstr("joint 1: corners that it joins are 1.41 of an edge apart"));
  sheet = rotating_squares(3, 1, 0.3);
  sheet.joints.pop_back();
  EXPECT_THAT(refused_tiles(sheet), HasSubstr("tile 3 hangs on no chain of joints with tile 1"));
  sheet.joints.clear();
  EXPECT_THAT(refused_tiles(sheet), HasSubstr("has no joints"));
  sheet = rotating_squares(3, 1, 0.3);
  sheet.tiles[1][1].y() = NAN;
  EXPECT_THAT(refused_tiles(sheet), HasSubstr("tile 2 has a coordinate that is not a finite number"));
}

}  // namespace
}  // namespace kinetix::model
