#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "mutation.hpp"

namespace kinetix::mutation {
namespace {

/// Appends a line for each test to the file in the environment variable KINETIX_REACHED: whether it passed, its
/// seconds, its name and the places that it executed.
class Recorder : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo&) override {
    for (auto& place : reached) place = false;
  }

  void OnTestEnd(const testing::TestInfo& test) override {
    std::ofstream out(std::getenv("KINETIX_REACHED"), std::ios::app);
    out << (test.result()->Failed() ? "failed " : "passed ")
        << static_cast<double>(test.result()->elapsed_time()) / 1000 << ' ' << test.test_suite_name() << '.'
        << test.name();
    for (int number = 0; number < most; ++number)
      if (reached[number]) out << ' ' << number;
    out << '\n';
  }
};

const bool recording = [] {
  if (std::getenv("KINETIX_REACHED")) testing::UnitTest::GetInstance()->listeners().Append(new Recorder);
  return true;
}();

}  // namespace
}  // namespace kinetix::mutation
