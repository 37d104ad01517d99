#include "optim/doe/random.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

namespace kinetix::optim {
namespace {

using ::testing::ElementsAre;

TEST(Philox, GivesThePublishedNumbers) {
  EXPECT_THAT(philox({0, 0, 0, 0}, {0, 0}), ElementsAre(0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8));
  EXPECT_THAT(philox({~0u, ~0u, ~0u, ~0u}, {~0u, ~0u}),
              ElementsAre(0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd));
  EXPECT_THAT(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
              ElementsAre(0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1));
}

TEST(RandomBits, DifferWhenAnyArgumentDiffers) {
  const RandomStream a = RandomStream::monte_carlo, b = RandomStream::bootstrap;
  const std::uint64_t high = std::uint64_t{1} << 32;
  const std::set<std::uint64_t> all = {random_bits(0, a, 0, 0),    random_bits(1, a, 0, 0),
                                       random_bits(high, a, 0, 0), random_bits(0, b, 0, 0),
                                       random_bits(0, a, 1, 0),    random_bits(0, a, high, 0),
                                       random_bits(0, a, 0, 1)};
  EXPECT_EQ(all.size(), 7u);
}

TEST(UnitInterval, IsOpenAndSymmetric) {
  EXPECT_EQ(unit_interval(0), 0x1p-53);
  EXPECT_EQ(unit_interval(~std::uint64_t{0}), 1 - 0x1p-53);
}

TEST(RandomOrder, HoldsEveryNumberOnce) {
  for (const std::uint64_t n : {1, 2, 3, 7, 64, 65, 1000, 4096}) {
    const RandomOrder order(n, 5 * n);
    std::set<std::uint64_t> seen;
    for (std::uint64_t i = 0; i < n; ++i) seen.insert(order(i));
    EXPECT_EQ(seen.size(), n);
    EXPECT_EQ(*seen.rbegin(), n - 1);
  }
}

TEST(RandomOrder, StaysBelowAVeryLargeCount) {
  const std::uint64_t n = 1'000'000'000'007;
  const RandomOrder order(n, 3);
  std::set<std::uint64_t> seen;
  for (std::uint64_t i = 0; i < 1000; ++i) seen.insert(order(n - 1 - i));
  EXPECT_EQ(seen.size(), 1000u);
  EXPECT_LT(*seen.rbegin(), n);
}

TEST(RandomOrder, MakesEveryOrderOfFourEquallyOften) {
  std::map<std::array<std::uint64_t, 4>, int> counts;
  const int keys = 24000;
  for (int key = 0; key < keys; ++key) {
    const RandomOrder order(4, random_bits(1, RandomStream::stratum_order, key, 0));
    ++counts[{order(0), order(1), order(2), order(3)}];
  }
  ASSERT_EQ(counts.size(), 24u);
  double chi_squared = 0;
  for (const auto& [order, count] : counts) chi_squared += (count - 1000.0) * (count - 1000.0) / 1000;
  EXPECT_LT(chi_squared, 49.7);  // 23 degrees of freedom, 0.1 %
}

}  // namespace
}  // namespace kinetix::optim
