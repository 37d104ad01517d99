#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

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

}  // namespace
}  // namespace kinetix::testing
