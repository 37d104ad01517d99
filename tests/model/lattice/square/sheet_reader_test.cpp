#include <gtest/gtest.h>

#include "model/lattice/square/family/classification.hpp"
#include "model/lattice/square/family/exact_family.hpp"
#include "tests/support/random_designs.hpp"

namespace kinetix::model {
namespace {

using namespace testing;

TEST(SheetReader, ReadsTheDesignThatClassifyFinds) {
  std::mt19937 random(11);
  for (const Family family : {Family::F1, Family::F2, Family::F3})
    for (int round = 0; round < 20; ++round) {
      const int columns = 1 + round % 5, rows = 1 + round / 5;
      const Structure s = structure_of(random_design(family, columns, rows, random));
      ExactDesign<double> design;
      ASSERT_TRUE(SheetReader(s).read(s, design));
      const Classification found = classify(s);
      for (int c = 0; c < columns; ++c) {
        EXPECT_NEAR(design.beta[c], found.design.beta[c], 1e-15);
        EXPECT_NEAR(design.t[c], found.design.t[c], 1e-15);
      }
      for (int r = 0; r < rows; ++r) EXPECT_NEAR(design.s[r], found.design.s[r], 1e-15);
      EXPECT_NEAR(design.gamma, found.design.gamma, 1e-15);
    }
}

TEST(SheetReader, RefusesEveryHingeThatClassifyRefuses) {
  std::mt19937 random(12);
  std::uniform_int_distribution<int> pick(0, 2);
  int refused = 0;
  for (int round = 0; round < 200; ++round) {
    Structure s = structure_of(random_design(Family::F2, 4, 3, random));
    HingeParameters& p = s.hinges[round % s.hinges.size()].parameters;
    const int which = pick(random);
    (which == 0 ? p.t : which == 1 ? p.alpha : p.beta) += 1e-6;
    ExactDesign<double> design;
    const Classification found = classify(s);
    const bool along_x = found.family != Family::none && found.family != Family::F4 && !found.transposed;
    EXPECT_EQ(SheetReader(s).read(s, design), along_x) << found.why;
    refused += !along_x;
  }
  EXPECT_GE(refused, 190);
}

}  // namespace
}  // namespace kinetix::model
