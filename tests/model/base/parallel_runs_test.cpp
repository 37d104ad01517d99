#include "model/base/parallel_runs.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/base/invalid_input.hpp"

namespace kinetix::model {
namespace {

TEST(ParallelRuns, DoEachOnce) {
  for (const int threads : {0, 1, 3, 64}) {
    std::vector<int> times(40);
    run_in_parallel(40, threads, [&](int k) { ++times[k]; });
    EXPECT_EQ(times, std::vector<int>(40, 1)) << threads;
  }
  run_in_parallel(0, 2, [](int) { FAIL(); });
}

TEST(ParallelRuns, ThrowWhatTheFirstOfThemThrewOnceAllHaveEnded) {
  std::atomic<int> ended{0};
  const auto run = [&](int k) {
    ++ended;
    if (k == 7 || k == 31) throw std::runtime_error(std::to_string(k));
  };
  for (const int threads : {1, 4}) {
    ended = 0;
    try {
      run_in_parallel(40, threads, run);
      FAIL();
    } catch (const std::runtime_error& e) {
      EXPECT_STREQ(e.what(), "7");
    }
    EXPECT_EQ(ended, 40);
  }
}

TEST(ParallelRuns, TakeAllCoresUnlessAskedOtherwise) {
  EXPECT_GE(threads_of(0), 1);
  EXPECT_EQ(threads_of(5), 5);
}

TEST(ParallelRuns, RefuseNumbersOfThreadsThatNoMachineHas) {
  const auto nothing = [](int) {};
  for (const int odd : {-1, -3, 1025, 100'000}) {
    EXPECT_THROW(threads_of(odd), InvalidInput) << odd;
    EXPECT_THROW(run_in_parallel(2, odd, nothing), InvalidInput) << odd;
  }
}

}  // namespace
}  // namespace kinetix::model
