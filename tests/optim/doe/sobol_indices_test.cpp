#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <array>

#include "model/base/invalid_input.hpp"
#include "optim/doe/analysis.hpp"
#include "tests/optim/doe/test_functions.hpp"

namespace kinetix::optim {
namespace {

using ::testing::HasSubstr;
using testing::KnownFunction;
using ::testing::ThrowsMessage;

SamplePlan plan(const KnownFunction& f, std::uint64_t base, std::uint64_t seed) {
  return {f.factors, {.method = SamplingMethod::saltelli, .samples = base, .seed = seed, .base = {}}};
}

SobolIndices indices(const KnownFunction& f, std::uint64_t base, std::uint64_t seed, int resamples = 2) {
  return sobol_indices(testing::responses(plan(f, base, seed), f.value), static_cast<int>(f.factors.size()),
                       {.resamples = resamples, .seed = seed});
}

void expect_closed_form(const KnownFunction& f, double tolerance) {
  const SobolIndices found = indices(f, 8192, 1);
  EXPECT_NEAR(found.mean, f.mean, tolerance);
  EXPECT_NEAR(found.variance / f.variance, 1, tolerance);
  for (std::size_t j = 0; j < f.factors.size(); ++j) {
    EXPECT_NEAR(found.factors[j].first.value, f.first[j], tolerance) << j;
    EXPECT_NEAR(found.factors[j].total.value, f.total[j], tolerance) << j;
  }
}

TEST(SobolIndices, AreThoseOfIshigamisFunction) { expect_closed_form(testing::ishigami(), 5e-3); }

TEST(SobolIndices, AreThoseOfTheGFunction) { expect_closed_form(testing::g_function(), 5e-3); }

/// How many of the 95 % intervals of 48 seeds, 3 factors, 2 indices hold the closed form.
template <class Indices>
double coverage(const Indices& indices) {
  const KnownFunction f = testing::ishigami();
  int inside = 0;
  for (std::uint64_t seed = 0; seed < 48; ++seed) {
    const SobolIndices found = indices(f, seed);
    for (std::size_t j = 0; j < 3; ++j) {
      const auto& [first, total, used_first, used_total] = found.factors[j];
      inside += first.lower <= f.first[j] && f.first[j] <= first.upper;
      inside += total.lower <= f.total[j] && f.total[j] <= total.upper;
    }
  }
  return inside / (48.0 * 6);
}

TEST(SobolIndices, IntervalsOfIndependentBasesHoldTheClosedFormAsOftenAsTheySay) {
  const double share = coverage([](const KnownFunction& f, std::uint64_t seed) {
    const SamplePlan draws({{"a0", f.factors[0].distribution},
                            {"a1", f.factors[0].distribution},
                            {"a2", f.factors[0].distribution},
                            {"b0", f.factors[0].distribution},
                            {"b1", f.factors[0].distribution},
                            {"b2", f.factors[0].distribution}},
                           {.method = SamplingMethod::monte_carlo, .samples = 400, .seed = seed, .base = {}});
    std::vector<double> responses;
    for (std::uint64_t n = 0; n < draws.size(); ++n) {
      const auto x = draws.sample(n);
      for (const auto& [i, j, k] : {std::array{0, 1, 2}, {3, 1, 2}, {0, 4, 2}, {0, 1, 5}, {3, 4, 5}})
        responses.push_back(f.value({x[i], x[j], x[k]}));
    }
    return sobol_indices(responses, 3, {.resamples = 200, .seed = seed});
  });
  EXPECT_GE(share, 0.91);
  EXPECT_LE(share, 0.98);
}

TEST(SobolIndices, IntervalsOfSobolsSequenceErrOnTheWideSide) {
  EXPECT_GE(coverage([](const KnownFunction& f, std::uint64_t seed) { return indices(f, 64, seed, 100); }),
            0.97);
}

TEST(SobolIndices, IntervalsShrinkAsTheRootOfTheBase) {
  const auto width = [](std::uint64_t base) {
    const Estimate total = indices(testing::ishigami(), base, 3, 400).factors[0].total;
    return total.upper - total.lower;
  };
  EXPECT_NEAR(width(256) / width(4096), 4, 1.2);
}

TEST(SobolIndices, DoNotSeeAConstantAddedToTheResponse) {
  const KnownFunction f = testing::ishigami();
  std::vector<double> responses = testing::responses(plan(f, 256, 1), f.value);
  const SobolIndices before = sobol_indices(responses, 3);
  for (double& response : responses) response += 1e6;
  const SobolIndices after = sobol_indices(responses, 3);
  for (std::size_t j = 0; j < 3; ++j)
    EXPECT_NEAR(after.factors[j].first.value, before.factors[j].first.value, 1e-8);
}

TEST(SobolIndices, SameSeedSameBits) {
  const SobolIndices a = indices(testing::ishigami(), 64, 5, 50), b = indices(testing::ishigami(), 64, 5, 50);
  EXPECT_EQ(a.factors[1].total.lower, b.factors[1].total.lower);
  EXPECT_EQ(a.factors[1].first.upper, b.factors[1].first.upper);
}

TEST(SobolIndices, AFailedRowDropsWhatDependsOnItAlone) {
  const KnownFunction f = testing::ishigami();
  std::vector<double> responses = testing::responses(plan(f, 64, 1), f.value);
  responses[5 * 3] = nan;                                          // A of base 3: all of it
  responses[5 * 7 + 1] = std::numeric_limits<double>::infinity();  // A with factor 0 of B
  responses[5 * 9 + 4] = nan;                                      // B: first-order indices
  const SobolIndices found = sobol_indices(responses, 3);
  EXPECT_EQ(found.bases, 64);
  EXPECT_EQ(found.failed, 3);
  EXPECT_EQ(found.factors[0].used_first, 61);
  EXPECT_EQ(found.factors[0].used_total, 62);
  EXPECT_EQ(found.factors[1].used_first, 62);
  EXPECT_EQ(found.factors[1].used_total, 63);
  EXPECT_NEAR(found.factors[1].first.value, f.first[1], 0.2);
}

TEST(SobolIndices, ABaseThatFailedIsAsIfItWereNotThere) {
  const KnownFunction f = testing::g_function();
  std::vector<double> failed = testing::responses(plan(f, 65, 1), f.value);
  const std::vector<double> without(failed.begin(), failed.end() - 8);
  std::fill(failed.end() - 8, failed.end(), nan);
  const SobolIndices a = sobol_indices(failed, 6), b = sobol_indices(without, 6);
  EXPECT_EQ(a.variance, b.variance);
  for (std::size_t j = 0; j < 6; ++j) {
    EXPECT_EQ(a.factors[j].first.value, b.factors[j].first.value);
    EXPECT_EQ(a.factors[j].total.value, b.factors[j].total.value);
  }
}

TEST(SobolIndices, AreNotKnownForAConstantOrWithoutRows) {
  for (const std::vector<double>& responses :
       {std::vector<double>(40, 0.1), std::vector<double>(40, nan), std::vector<double>{}, {1, 2, 3, 4}}) {
    const SobolIndices found = sobol_indices(responses, 2);
    EXPECT_TRUE(std::isnan(found.factors[0].first.value));
    EXPECT_TRUE(std::isnan(found.factors[1].total.lower));
  }
}

TEST(SobolIndices, RefuseATableOfAnotherShape) {
  const auto because = [](const char* words) { return ThrowsMessage<InvalidInput>(HasSubstr(words)); };
  const std::vector<double> responses(10, 1.0);
  EXPECT_THAT([&] { sobol_indices(responses, 2); }, because("10 responses"));
  EXPECT_THAT([&] { sobol_indices(responses, 0); }, because("factors is 0"));
  EXPECT_THAT([&] { sobol_indices(responses, 3, {.level = nan}); }, because("confidence level is nan"));
  EXPECT_THAT([&] { sobol_indices(responses, 3, {.resamples = 1}); }, because("resamples is 1"));
}

}  // namespace
}  // namespace kinetix::optim
