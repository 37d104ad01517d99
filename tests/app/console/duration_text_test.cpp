#include <gtest/gtest.h>

#include "app/console/console.hpp"
#include "app/run/plan.hpp"

namespace kinetix::app {
namespace {

TEST(DurationText, IsAsLongAsWhatItSays) {
  EXPECT_EQ(duration_text(0.234), "0.23 s");
  EXPECT_EQ(duration_text(41.7), "41 s");
  EXPECT_EQ(duration_text(250), "4 min 10 s");
  EXPECT_EQ(duration_text(12000), "3 h 20 min");
}

TEST(About, IsNoMoreExactThanAnEstimate) {
  EXPECT_EQ(about(0.4), "less than a second");
  EXPECT_EQ(about(2.3), "about 2 s");
  EXPECT_EQ(about(280), "about 5 minutes");
  EXPECT_EQ(about(3 * 3600.0), "about 3 hours");
}

}  // namespace
}  // namespace kinetix::app
