#include "model/closure/null_space.hpp"

#include <gtest/gtest.h>

#include "model/closure/closure.hpp"
#include "tests/support/random_designs.hpp"
#include "tests/support/sodalite_arms.hpp"

namespace kinetix::model {
namespace {

using testing::random_design;
using testing::structure_of;

TEST(NullSpace, CountsOneFreedomOfEveryFamilyAtFlatAndFolded) {
  std::mt19937 random(31);
  for (const Family family : {Family::F1, Family::F2, Family::F3})
    for (const auto& [columns, rows] : {std::pair{1, 1}, {3, 2}, {6, 6}, {20, 1}, {20, 20}}) {
      const auto design = random_design(family, columns, rows, random);
      const Structure s = structure_of(design);
      EXPECT_EQ(null_space(s, rest_state(s)).dofs(), 1) << to_string(family) << " seed 31";
      EXPECT_EQ(null_space(s, fold(design, s)).dofs(), 1) << to_string(family) << " seed 31";
    }
}

TEST(NullSpace, DenseAndInverseIterationAgree) {
  std::mt19937 random(32);
  const Structure sheets[] = {structure_of(random_design(Family::F3, 4, 3, random)),
                              make_structure({{0, 0}, {1, 1}, {2, 2}}, {}),
                              make_structure(rectangle(5, 4), {})};
  for (const Structure& s : sheets) {
    const NullSpace dense = null_space(s, rest_state(s), NullSpaceMethod::dense);
    const NullSpace sparse = null_space(s, rest_state(s), NullSpaceMethod::inverse_iteration);
    ASSERT_EQ(dense.dofs(), sparse.dofs());
    EXPECT_NEAR(dense.smallest_other, sparse.smallest_other, 1e-6);
    const Eigen::MatrixXd overlap = dense.basis.transpose() * sparse.basis;
    EXPECT_LE((overlap * overlap.transpose() - Eigen::MatrixXd::Identity(dense.dofs(), dense.dofs())).norm(),
              1e-12);
  }
}

TEST(NullSpace, GrowsItsBlockUntilEveryFreedomIsFound) {
  std::vector<Cell> chain;
  for (int k = 0; k < 20; ++k) chain.push_back({k, k});
  const Structure s = make_structure(chain, {});
  EXPECT_EQ(null_space(s, rest_state(s), NullSpaceMethod::inverse_iteration).dofs(), 20);
}

// Arms of 1e-6 of an edge: rotors that turn alone open their hinges by so little.
TEST(NullSpace, ToldFromDirectionsThatAreNearlyFree) {
  const SodaliteStructure block =
      testing::block_with_arms({1, 1, 1}, {1e-6, 2e-6, 5e-7, 1e-6, 3e-6, 1e-6}, {10, 0.4, 1});
  const State state = exact_motion(block).at(0.4);
  EXPECT_EQ(null_space(block, state, NullSpaceMethod::dense).dofs(), 1);
  EXPECT_EQ(null_space(block, state, NullSpaceMethod::inverse_iteration).dofs(), 1);
}

TEST(NullSpace, BasisIsOrthonormalHoldsTheFirstBodyAndClosesEveryHinge) {
  std::mt19937 random(33);
  const auto design = random_design(Family::F2, 12, 9, random);
  const Structure s = structure_of(design);
  const State state = fold(design, s);
  const NullSpace space = null_space(s, state);
  EXPECT_NEAR((space.basis.transpose() * space.basis)(0, 0), 1, 1e-14);
  EXPECT_EQ(space.basis.topRows(6).norm(), 0);
  EXPECT_LE((closure_jacobian(s, state) * space.basis).norm(), 1e-13) << "seed 33";
}

}  // namespace
}  // namespace kinetix::model
