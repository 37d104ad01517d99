#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>

#include "model/base/invalid_input.hpp"
#include "model/closure/closure.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/square/family/classification.hpp"
#include "model/lattice/square/family/drive.hpp"
#include "tests/support/bad_input.hpp"
#include "tests/support/random_designs.hpp"
#include "tests/support/random_nets.hpp"

namespace kinetix::model {
namespace {

using testing::cube_net;
using testing::fishbone;

constexpr Grip base{{3, 3}, {5, 5}};  // vertices of the cube's middle face in testing::cube_net

bool keeps(const Structure& s, Axis axis, const Grip& grip) {
  const Classification kind = classify(s);
  return keeps_between_plates(s, gripped_bodies(s, axis, grip),
                              [&](double theta) { return fold(kind, s, theta); });
}

TEST(Grip, TakesTheFirstAndTheLastRowOfItsRectangle) {
  const Structure net = cube_net(0.5);
  const auto vertices = [&](const std::vector<int>& row) {
    std::vector<Vertex> out;
    for (const int body : row) out.push_back(net.bodies[body]);
    return out;
  };
  const GrippedRows across_x = gripped_bodies(net, Axis::x, base), whole = gripped_bodies(net, Axis::y);
  EXPECT_EQ(vertices(across_x[0]), (std::vector<Vertex>{{3, 3}, {3, 4}, {3, 5}}));
  EXPECT_EQ(vertices(across_x[1]), (std::vector<Vertex>{{5, 3}, {5, 4}, {5, 5}}));
  EXPECT_EQ(vertices(whole[1]), (std::vector<Vertex>{{3, 11}, {4, 11}, {5, 11}}));
}

TEST(Grip, FindsThePlanesOfCurvedRowsHoweverTheyStand) {
  const Structure sheet = make_structure(rectangle(4, 2), {});
  const GrippedRows rows = gripped_bodies(sheet, Axis::y);
  State state = rest_state(sheet);
  for (Pose& pose : state) pose.p.z() = 0.01 * pose.p.x() * pose.p.x();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).matrix();
  for (Pose& pose : state) pose.p = turn * (pose.p + Eigen::Vector3d(0.4 * pose.p.y(), 0, 0));
  const RowPlanes planes = planes_of(rows, state);
  EXPECT_NEAR(planes.distance, 20, 1e-9);
  EXPECT_LE(planes.off_plane, 1e-9);
  EXPECT_LE((planes.normal - turn.col(1)).norm(), 1e-9);
}

TEST(Grip, PlatesHoldAFlatPanelOfANetAndASpineByItsLongSides) {
  const Structure cube = cube_net(0.9);
  EXPECT_TRUE(keeps(cube, Axis::x, base));
  EXPECT_TRUE(keeps(cube, Axis::y, base));
  EXPECT_TRUE(keeps(cube, Axis::x, {{3, 0}, {5, 11}}));   // four faces on edge between the plates
  EXPECT_FALSE(keeps(cube, Axis::y, {{3, 0}, {5, 11}}));  // the same would roll
  EXPECT_FALSE(keeps(cube, Axis::y, {{3, 2}, {5, 5}}));   // and with one crease
  const Structure net = fishbone(3, 12, 0.2);
  EXPECT_TRUE(keeps(net, Axis::x, {{3, 0}, {4, 12}}));
  EXPECT_FALSE(keeps(net, Axis::y, {{3, 0}, {4, 12}}));
  EXPECT_TRUE(keeps(net, Axis::y, {{0, 2}, {7, 3}}));
  EXPECT_FALSE(keeps(net, Axis::x, {{0, 2}, {7, 3}}));
}

TEST(Grip, RefusesRowsThatZigzag) {
  auto design = ExactDesign<double>::basic(4, 4);
  design.t[1] = 0.7;
  const Structure sheet = testing::structure_of(design);
  EXPECT_FALSE(keeps(sheet, Axis::y, {{0, 0}, {4, 2}}));
  EXPECT_TRUE(keeps(sheet, Axis::y, {{2, 0}, {4, 2}}));
  EXPECT_TRUE(keeps(sheet, Axis::x, {{0, 0}, {4, 2}}));  // across, the column only shears
}

TEST(Grip, NetsAreGrippedAtTheirMiddle) {
  const auto of_cube = find_net_grip(cube_net(0.5));
  ASSERT_TRUE(of_cube);
  EXPECT_EQ(of_cube->grip, base);
  const auto of_bone = find_net_grip(fishbone(5, 8, 0.2));
  ASSERT_TRUE(of_bone);
  EXPECT_EQ(of_bone->grip, (Grip{{5, 0}, {6, 8}})) << "its spine, though ribs are longer";
  EXPECT_EQ(of_bone->axis, Axis::x);
}

TEST(Grip, DrivesOfRandomNetsHoldPartsThatPlatesKeep) {
  constexpr unsigned seed = 41;
  std::mt19937 random(seed);
  int gripped = 0;
  for (int k = 0; k < 40; ++k) {
    const Structure net = testing::random_net(5 + 2 * k, random);
    const Drive drive = drive_to(net, 0.4);
    const LinkageDrive made = drive_on(net, drive);
    if (const auto* turn = std::get_if<HingeTurn>(&drive)) {
      const State folded = fold(classify(net), net, 0.4);
      EXPECT_NEAR(hinge_turn(net, folded, turn->hinge), turn->angle, 1e-12);
      continue;
    }
    EXPECT_NEAR(made.theta(), 0.4, 1e-12);
    const Plates& plates = std::get<Plates>(drive);
    if (!plates.grip) continue;
    EXPECT_TRUE(keeps(net, plates.axis, *plates.grip)) << "seed " << seed << ", net " << k;
    ++gripped;
  }
  EXPECT_GE(gripped, 10) << "seed " << seed;
}

TEST(Grip, BadPartsAreRefused) {
  const Structure net = cube_net(0.5);
  const auto why = [&](const Grip& grip, Axis axis) {
    return testing::refusal([&] { plate_drive(net, axis, 0, 1, grip); });
  };
  EXPECT_EQ(why(base, Axis::x), "");
  EXPECT_NE(why({{3, 3}, {3, 5}}, Axis::x).find("at least one cell both ways"), std::string::npos);
  EXPECT_NE(why({{5, 5}, {3, 3}}, Axis::x).find("lower left"), std::string::npos);
  EXPECT_NE(why({{2, 2}, {5, 5}}, Axis::x).find("no vertex [2, 2]"), std::string::npos);
  EXPECT_NE(why({{3, 3}, {5, 99}}, Axis::y).find("no vertex [3, 99]"), std::string::npos);
  const std::string rolls = testing::refusal([&] {
    require_kept_rows(net, classify(net), Axis::y, Grip{{3, 2}, {5, 5}});
  });
  EXPECT_NE(rolls.find("do not stay in two parallel planes"), std::string::npos);
}

}  // namespace
}  // namespace kinetix::model
