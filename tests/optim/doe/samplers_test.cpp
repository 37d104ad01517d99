#include <gtest/gtest.h>
#include <set>

#include "optim/doe/samplers.hpp"

namespace kinetix::optim {
namespace {

double fraction(std::uint64_t coordinate) { return static_cast<double>(coordinate) * 0x1p-64; }

/// Joe and Kuo's notes on their direction numbers: the first ten points in three dimensions.
TEST(SobolSequence, StartsWithThePublishedPoints) {
  const double published[10][3] = {{0, 0, 0},
                                   {0.5, 0.5, 0.5},
                                   {0.75, 0.25, 0.25},
                                   {0.25, 0.75, 0.75},
                                   {0.375, 0.375, 0.625},
                                   {0.875, 0.875, 0.125},
                                   {0.625, 0.125, 0.875},
                                   {0.125, 0.625, 0.375},
                                   {0.1875, 0.3125, 0.9375},
                                   {0.6875, 0.8125, 0.4375}};
  const SobolSequence sequence(3);
  for (int n = 0; n < 10; ++n)
    for (int j = 0; j < 3; ++j)
      EXPECT_EQ(fraction(sequence.coordinate(n, j)), published[n][j]) << n << " " << j;
}

/// A row of Joe and Kuo's file new-joe-kuo-6.21201.
struct PublishedDimension {
  int degree;
  unsigned polynomial;
  std::vector<std::uint64_t> initial;
};

/// Their recurrence for the directions and the sequence one point from the one before.
std::vector<std::uint64_t> points(const PublishedDimension& row, int count) {
  std::vector<std::uint64_t> v(32);
  const int s = row.degree;
  for (int k = 0; k < 32; ++k) {
    if (k < s) {
      v[k] = row.initial[k] << (63 - k);
      continue;
    }
    v[k] = v[k - s] ^ v[k - s] >> s;
    for (int m = 1; m < s; ++m)
      if (row.polynomial >> (s - 1 - m) & 1) v[k] ^= v[k - m];
  }
  std::vector<std::uint64_t> x(1, 0);
  for (int n = 1; n < count; ++n) {
    int k = 0;
    while ((n - 1) >> k & 1) ++k;
    x.push_back(x.back() ^ v[k]);
  }
  return x;
}

TEST(SobolSequence, FollowsThePublishedDirectionNumbers) {
  const PublishedDimension rows[] = {{1, 0, {1}},
                                     {2, 1, {1, 3}},
                                     {3, 1, {1, 3, 1}},
                                     {3, 2, {1, 1, 1}},
                                     {4, 1, {1, 1, 3, 3}},
                                     {4, 4, {1, 3, 5, 13}},
                                     {5, 2, {1, 1, 5, 5, 17}},
                                     {5, 4, {1, 1, 5, 5, 5}},
                                     {5, 7, {1, 1, 7, 11, 19}}};
  const SobolSequence sequence(10);
  for (int j = 0; j < 9; ++j) {
    const auto expected = points(rows[j], 2000);
    for (int n = 0; n < 2000; ++n) ASSERT_EQ(sequence.coordinate(n, j + 1), expected[n]) << n << " " << j;
  }
}

TEST(SobolSequence, PutsOnePointIntoEachStratumOfEveryDimension) {
  const SobolSequence sequence(SobolSequence::max_dimensions);
  for (int j = 0; j < sequence.dimensions(); j += 61) {
    std::set<std::uint64_t> strata;
    for (std::uint64_t n = 256; n < 512; ++n) strata.insert(sequence.coordinate(n, j) >> 56);
    EXPECT_EQ(strata.size(), 256u) << j;
  }
}

}  // namespace
}  // namespace kinetix::optim
