#include "sim/start_motion.hpp"

#include <gtest/gtest.h>

#include "model/lattice/square/family/exact_jacobian.hpp"
#include "tests/support/random_designs.hpp"

namespace kinetix::sim {
namespace {

TEST(StartMotion, IsTheRateOfTheExactFoldAtFlat) {
  std::mt19937 random(31);
  for (const model::Family family : {model::Family::F1, model::Family::F2, model::Family::F3}) {
    auto design = testing::random_design(family, 6, 2, random);
    const model::Structure structure = testing::structure_of(design);
    const std::vector<model::Twist> motion = start_motion(structure);
    design.theta = 0;
    model::State poses;
    model::ExactJacobian jacobian;
    fold_with_jacobian(design, structure.size.edge_mm, poses, jacobian);
    for (const model::Hinge& hinge : structure.hinges) {
      const Eigen::Vector3d relative = motion[hinge.upper].omega - motion[hinge.lower].omega;
      const Eigen::Vector3d exact = jacobian.twist(jacobian.theta(), hinge.upper).omega -
                                    jacobian.twist(jacobian.theta(), hinge.lower).omega;
      const double scale = relative.norm() / exact.norm();
      EXPECT_LE((relative - scale * exact).norm(), 1e-9) << to_string(family);
      EXPECT_GT(relative.dot(exact), 0);
    }
  }
}

TEST(StartMotion, IsBareSpinsWhereNothingMoves) {
  model::Structure structure = make_structure(model::rectangle(3, 3), {});
  std::mt19937 random(32);
  std::uniform_real_distribution<double> unit(0, 1);
  for (model::Hinge& hinge : structure.hinges)
    hinge.parameters = {0.2 + 0.6 * unit(random), 1.2 + 0.7 * unit(random), unit(random) - 0.5};
  const std::vector<model::Twist> motion = start_motion(structure);
  for (std::size_t b = 0; b < motion.size(); ++b) {
    EXPECT_EQ(motion[b].v, Eigen::Vector3d::Zero());
    EXPECT_EQ(motion[b].omega, Eigen::Vector3d(0, 0, structure.bodies[b].sense()));
  }
}

TEST(StartMotion, IsThrownOffTheSameWayByTheSameSeed) {
  std::vector<model::Twist> once(50), again(50), other(50), flat(50), none(50);
  disturb(once, 0.3, 1, false);
  disturb(again, 0.3, 1, false);
  disturb(other, 0.3, 2, false);
  disturb(flat, 0.3, 1, true);
  disturb(none, 0, 1, false);
  double largest = 0;
  for (std::size_t b = 0; b < once.size(); ++b) {
    EXPECT_EQ(once[b].omega, again[b].omega);
    EXPECT_EQ(once[b].v, again[b].v);
    EXPECT_NE(once[b].omega, other[b].omega);
    EXPECT_EQ(flat[b].omega, Eigen::Vector3d(0, 0, once[b].omega.z()));
    EXPECT_EQ(flat[b].v, Eigen::Vector3d(once[b].v.x(), once[b].v.y(), 0));
    EXPECT_EQ(none[b].omega, Eigen::Vector3d::Zero());
    largest = std::max(largest, once[b].v.lpNorm<Eigen::Infinity>());
  }
  EXPECT_LE(largest, 0.3);
  EXPECT_GE(largest, 0.28) << "of 150 numbers";
}

}  // namespace
}  // namespace kinetix::sim
