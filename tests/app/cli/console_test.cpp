#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>
#include <sstream>

#include "app/console/console.hpp"

namespace kinetix::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Console, SaysOfStagesThatTakeLongAloneWhereItIsAskedTo) {
  ::testing::internal::CaptureStderr();
  {
    app::Console console(false, false, std::chrono::seconds(1));
    console.stage("building solids", -1);
    console.stage("writing files", 0.5);
    usleep(1'600'000);
  }
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_THAT(said, Not(HasSubstr("building")));
  EXPECT_THAT(said, HasSubstr("writing files ... 50 %"));
}

TEST(TimeLeft, CountsDownAndNeverGoesUp) {
  app::TimeLeft left;
  EXPECT_EQ(left.text(0), "");
  left.update(0, 0.5);  // progress of an earlier run that is resumed: no evidence of the speed
  EXPECT_EQ(left.text(3), "");
  left.update(10, 0.6);
  EXPECT_EQ(left.text(10), "about 40 s left");
  EXPECT_EQ(left.text(25), "about 25 s left");
  left.update(26, 0.7);  // extrapolation would give 39 s
  EXPECT_EQ(left.text(26), "still working, longer than estimated");
  left.update(30, 0.9);
  EXPECT_EQ(left.text(30), "about 7.5 s left");
  left.update(31, 0.9);  // repeats the share, so it adds no evidence
  EXPECT_EQ(left.text(31), "about 6.5 s left");
  EXPECT_EQ(left.text(40), "still working, longer than estimated");
  left.update(41, 1);
  EXPECT_EQ(left.text(41), "");
}

TEST(TimeLeft, StandsWhereALaterShareIsALittleSlower) {
  app::TimeLeft left;
  left.update(0, 0);
  left.update(10, 0.5);
  EXPECT_NEAR(*left.at(10), 10, 1e-12);
  left.update(14, 0.6);  // 9.33 s
  EXPECT_NEAR(*left.at(16), 14 + 14 * 0.4 / 0.6 - 16, 1e-12);
  left.update(18, 0.7);  // 7.71 s by extrapolation, after 7.33 s was displayed
  EXPECT_NEAR(*left.at(18), 14 + 14 * 0.4 / 0.6 - 16, 1e-12);
  left.update(28, 0.71);
  EXPECT_FALSE(left.at(28));
}

/// Prints lines if stderr is not a terminal.
TEST(Console, ReportsHowFarAStageIsAtIntervals) {
  ::testing::internal::CaptureStderr();
  {
    app::Console console(false, true, std::chrono::seconds(1));
    console.stage("folding", 0);
    usleep(900'000);
    console.stage("folding", 0.2);  // 3.6 s are left
    usleep(1'700'000);
    console.stage("writing", -1);
  }
  {
    app::Console quiet(true);
    quiet.stage("silence", 0.5);
  }
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_THAT(said,
              AllOf(HasSubstr("folding ...\nfolding ... 20 %, 1"), HasSubstr("left\nfolding ... 20 %, 2"),
                    HasSubstr("\nwriting ...\n"), Not(HasSubstr("silence"))));
}

/// Returns what a program prints on a terminal of 80 columns.
std::string shown_on_terminal(const std::function<void()>& program) {
  int terminal = 0;
  winsize size{.ws_row = 24, .ws_col = 80, .ws_xpixel = 0, .ws_ypixel = 0};
  const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
  if (child == 0) {
    program();
    _exit(0);
  }
  std::string text;
  char part[4096];
  for (ssize_t count = 0; (count = read(terminal, part, sizeof part)) > 0;)
    text.append(part, static_cast<std::size_t>(count));
  waitpid(child, nullptr, 0);
  close(terminal);
  return text;
}

TEST(Console, KeepsProgressOnOneLineOfATerminal) {
  const std::string shown = shown_on_terminal([] {
    app::Console console(false);
    console.stage("prints, contact", 0.25, {}, "start 3 of 8, best 0.12 mm off, " + std::string(60, 'x'));
    console.stage("search", -1, {}, std::string(120, 'y'));
    usleep(1'300'000);
  });
  EXPECT_THAT(shown, HasSubstr("prints, contact    [#####"));
  EXPECT_EQ(shown.find('\n'), std::string::npos) << shown;
  std::istringstream in(shown);
  for (std::string line; std::getline(in, line, '\r');)
    EXPECT_LE(line.size(), 79 + std::string("\033[K").size());
}

}  // namespace
}  // namespace kinetix::testing
