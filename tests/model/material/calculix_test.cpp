#include <gtest/gtest.h>

#include "tests/support/calculix_block.hpp"

namespace kinetix::model {
namespace {

struct Block {
  double slenderness, height, nu;  ///< L / t, h / t
};

TEST(ManufacturedHinge, IsAsStiffAsCalculixFindsABlockOfItsSize) {
  ASSERT_TRUE(testing::has_calculix()) << "CalculiX is not installed: make packages";
  for (const Block& c :
       {Block{0.6, 5, 0.45}, Block{1, 5, 0.45}, Block{1, 10, 0.48}, Block{1, 5, 0.48}, Block{1.25, 7.5, 0.45},
        Block{1.5, 5, 0.3}, Block{2, 5, 0.4}, Block{4, 5, 0.45}, Block{4, 10, 0.3}, Block{4, 7.5, 0.48}}) {
    SCOPED_TRACE(::testing::Message() << "L/t " << c.slenderness << ", h/t " << c.height << ", nu " << c.nu);
    const ManufacturedHinge block = testing::block_of(c.slenderness, c.height, c.nu);
    const auto m = testing::calculix_stiffness(block);
    ASSERT_TRUE(m);
    const HingeStiffness k = stiffness(block);
    EXPECT_NEAR(k.axial / m->axial, 1, 0.03);
    EXPECT_NEAR(k.shear / m->shear, 1, 0.08);
    EXPECT_NEAR(k.along / m->along, 1, 0.04);
    EXPECT_NEAR(k.turn / m->turn, 1, 0.02);
    EXPECT_NEAR(k.rock.value() / m->rocking, 1, 0.08);
    EXPECT_NEAR(k.twist.value() / m->twist, 1, 0.03);
  }
}

}  // namespace
}  // namespace kinetix::model
