#include <gtest/gtest.h>
#include <Eigen/Dense>
#include <random>

#include "sim/joints/row_system.hpp"
#include "sim/rigid_parts.hpp"
#include "sim/shapes/part_shape.hpp"
#include "sim/world.hpp"
#include "tests/sim/runs.hpp"

namespace kinetix::sim {
namespace {

TEST(WallPrisms, EndOnTheHingeAxisAndMeetTheOtherHalf) {
  model::Structure structure = make_structure(model::rectangle(2, 1), {});
  for (model::Hinge& hinge : structure.hinges) hinge.parameters = {0.3, 1.2, 0.4};
  const auto walls = wall_prisms(structure);
  for (std::size_t b = 0; b < walls.size(); ++b)
    for (const WallPrism& wall : walls[b]) {
      const model::Hinge& hinge = structure.hinges[wall.hinge];
      const Eigen::Vector3d axis = hinge_axis(hinge.wall.axis, hinge.parameters);
      const Eigen::Vector3d point =
          (structure.hinge_point(hinge) - structure.rest_position(static_cast<int>(b))) /
          structure.size.edge_mm;
      const auto& p = wall.prism;
      const Eigen::Vector3d top = (p[5] + p[7]) / 2 - point, bottom = (p[1] + p[3]) / 2 - point;
      EXPECT_LE(top.cross(axis).norm(), 1e-14);
      EXPECT_LE((top + bottom).norm(), 1e-14);
      EXPECT_NEAR((top - bottom).norm() * std::sin(1.2), 0.6, 1e-14);
      EXPECT_NEAR((p[2] - p[0]).norm(), 0.08, 1e-14);
    }
}

TEST(World, KeepsTheMiddleEulerAngleOfEveryHingeNearZeroBeyondAQuarterTurn) {
  auto design = model::ExactDesign<double>::basic(3, 1);
  design.t = {0.7, 0.8, 0.7};
  const model::Structure structure = testing::structure_of(design);
  const double theta = 1.0;
  World world(structure, drive_on(structure, drive_to(structure, theta)), testing::physics_without_contact());
  world.parts().push(theta);
  for (int k = 1; k <= 1000; ++k) {
    world.set_drive(theta * k / 1000);
    world.step();
    ASSERT_LE(world.largest_middle_angle(), 1e-3);
  }
  const model::State state = world.parts().state();
  const model::Hinge& hinge = structure.hinges[0];
  const Eigen::Matrix3d turn = state[hinge.lower].R.transpose() * state[hinge.upper].R;
  EXPECT_LT(turn(0, 0), std::cos(1.9));
}

TEST(World, KeepsTheMiddleEulerAngleSmallWhereHingesAreTilted) {
  const auto design = testing::strip(testing::curl(6, 0.6), 0.6);
  const model::Structure structure = testing::structure_of(design);
  World world(structure, drive_on(structure, drive_to(structure, 0.6)), testing::physics_without_contact());
  world.parts().push(0.6);
  for (int k = 1; k <= 1000; ++k) {
    world.set_drive(0.6e-3 * k);
    world.step();
    ASSERT_LE(world.largest_middle_angle(), 1e-3);
  }
}

/// Random rows between neighbours of a chain of parts, every one given twice, and one to the ground.
std::vector<VelocityRow> chain_rows(int parts, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&] {
    Vector6 v;
    for (double& x : v) x = unit(random);
    return v;
  };
  std::vector<VelocityRow> rows{{0, -1, vector(), vector(), 0.5, 1}};
  for (int p = 0; p + 1 < parts; ++p)
    for (int k = 0; k < 3; ++k) {
      rows.push_back({p + k % 2, p + 1 - k % 2, vector(), vector(), unit(random), 1});
      rows.push_back(rows.back());
    }
  return rows;
}

TEST(RowSystem, MeetsRepeatedRowsWithTheLeastMotion) {
  std::mt19937 random(40);
  constexpr int parts = 7;
  const Vector6 mass{1, 1, 1, 0.1, 0.1, 0.1};
  RowSystem system;
  for (int round = 0; round < 2; ++round) {
    const auto rows = chain_rows(parts, random);
    const PartMass part{1, 0.1 * Eigen::Matrix3d::Identity()};
    system.factorise(std::vector(parts, part), rows, 1e9);
    const Eigen::VectorXd v = system.velocities();

    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()), 6 * parts);
    Eigen::VectorXd target(rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
      jacobian.block<1, 6>(k, 6 * rows[k].a) = rows[k].first;
      if (rows[k].b >= 0) jacobian.block<1, 6>(k, 6 * rows[k].b) = rows[k].second;
      target[k] = rows[k].target;
    }
    const Eigen::VectorXd root = mass.replicate<parts, 1>().cwiseSqrt();
    const Eigen::MatrixXd scaled = jacobian * root.cwiseInverse().asDiagonal();
    const Eigen::VectorXd expected =
        scaled.completeOrthogonalDecomposition().solve(target).cwiseQuotient(root);
    EXPECT_LE((jacobian * v - target).norm(), 1e-6);
    EXPECT_LE((v - expected).norm(), 1e-4);
  }
}

}  // namespace
}  // namespace kinetix::sim
