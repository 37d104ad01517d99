#include "app/cli/error_report.hpp"

#include <gtest/gtest.h>

#include <exception>
#include <new>
#include <stdexcept>
#include <thread>

namespace kinetix::app {
namespace {

template <class Error>
[[noreturn]] void end_uncaught(const Error& error) {
  std::set_terminate(terminate_with_message);
  std::thread([&] { throw error; }).join();
  std::abort();
}

TEST(ErrorReport, NamesMemoryThatNobodyCouldCatch) {
  EXPECT_EXIT(end_uncaught(std::bad_alloc()), ::testing::ExitedWithCode(1), "^there is not enough memory\n$");
}

TEST(ErrorReport, SaysWhatNobodyCaught) {
  EXPECT_EXIT(end_uncaught(std::runtime_error("a thread has no stack")), ::testing::ExitedWithCode(1),
              "^a thread has no stack\n$");
}

TEST(ErrorReport, SaysThatTheProgramEndedItselfWithoutAnException) {
  EXPECT_EXIT(terminate_with_message(), ::testing::ExitedWithCode(1),
              "^internal error: the program ended itself\n$");
}

}  // namespace
}  // namespace kinetix::app
