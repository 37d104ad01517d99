#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/elastic/path/path_record.hpp"
#include "tests/support/elastic_runs.hpp"

namespace kinetix::model {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Kind = PathEvent::Kind;
using Descent = Branch::Descent;

EquilibriumStep step_at(double drive, double load, int contacts) {
  EquilibriumStep step;
  step.theta = step.drive = drive;
  step.load = load;
  step.contacts = contacts;
  return step;
}

TEST(JammingDetector, SeesALoadThatRisesThirtyTimesAsSteeplyAsWithoutContactOnce) {
  JammingDetector lock;
  EXPECT_FALSE(lock.see(step_at(0, 0, 0), step_at(1, 2, 0)));
  EXPECT_FALSE(lock.see(step_at(1, 2, 0), step_at(2, 102, 1))) << "contact began on this step";
  EXPECT_FALSE(lock.see(step_at(2, 102, 1), step_at(3, 162, 1))) << "thirty times";
  EXPECT_FALSE(lock.see(step_at(3, 162, 1), step_at(3, 300, 1))) << "the drive rests";
  EXPECT_EQ(lock.see(step_at(3, 162, 1), step_at(4, 242, 1)), 40);
  EXPECT_TRUE(lock.has_locked());
  EXPECT_FALSE(lock.see(step_at(4, 242, 1), step_at(5, 442, 1)));
}

/// Events of a sheet without contact, so that contacts are what steps say.
class EventsOfASheet : public ::testing::Test {
 protected:
  std::vector<Kind> kinds() const {
    std::vector<Kind> kinds;
    for (const PathEvent& event : events_.events()) kinds.push_back(event.kind);
    return kinds;
  }
  void see(const EquilibriumStep& before, const EquilibriumStep& after, const Arrival& arrival) {
    events_.see(before, after, rest_state(sheet_), arrival);
  }

  const Structure sheet_ = make_structure(rectangle(2, 2), {});
  const ElasticSystem system_{sheet_, {}, drive_on(sheet_, plates_drive(Axis::y, 0.5)), true, false};
  const ExactMotion none_;
  const ClosedForm closed_form_{system_, none_};
  PathEvents events_{system_, closed_form_, false};
};

TEST_F(EventsOfASheet, AreNoneOnASmoothPath) {
  see(step_at(0, 0, 0), step_at(1, 1, 0), {});
  EXPECT_THAT(kinds(), IsEmpty());
}

TEST_F(EventsOfASheet, TellWhereWallsBeginToTouchAndPart) {
  see(step_at(0, 0, 0), step_at(1, 1, 2), {});
  see(step_at(1, 1, 2), step_at(2, 1, 1), {});
  see(step_at(2, 1, 1), step_at(3, 1, 0), {});
  EXPECT_THAT(kinds(), ElementsAre(Kind::contact, Kind::release));
  EXPECT_EQ(events_.events()[1].at.drive, 3);
  EXPECT_EQ(events_.events()[1].since, 2);
}

TEST_F(EventsOfASheet, TellAlongWhatAnUnstableEquilibriumWasLeft) {
  see(step_at(0, 0, 0), step_at(1, 1, 0), {Descent::closed_form, false, true});
  see(step_at(1, 1, 0), step_at(2, 1, 0), {Descent::lowest_mode, true, false});
  EXPECT_THAT(kinds(), ElementsAre(Kind::bifurcation, Kind::snap));
  EXPECT_THAT(events_.events()[0].what, HasSubstr("left along the exact mode"));
  EXPECT_THAT(events_.events()[1].what, HasSubstr("left along the lowest mode"));
  EXPECT_TRUE(std::isnan(events_.off_closed_form().since));
}

TEST_F(EventsOfASheet, KnowSinceWhenAPathIsOffItsClosedForm) {
  see(step_at(0, 0, 0), step_at(1, 1, 0), {Descent::off_closed_form, false, false});
  see(step_at(1, 1, 0), step_at(2, 2, 0), {});
  EXPECT_EQ(events_.off_closed_form().since, 1);
  see(step_at(2, 2, 0), step_at(3, 3, 0), {Descent::lowest_mode, false, false});
  EXPECT_EQ(events_.off_closed_form().since, 1);
  see(step_at(3, 3, 0), step_at(4, 4, 0), {Descent::closed_form, false, true});
  EXPECT_TRUE(std::isnan(events_.off_closed_form().since));
}

TEST_F(EventsOfASheet, EndLockedByAContactFurtherOn) {
  events_.end_locked(step_at(1, 1, 0), {}, "why");
  EXPECT_THAT(kinds(), ElementsAre(Kind::contact, Kind::lock));
  EXPECT_EQ(events_.events()[1].what, "why");
}

}  // namespace
}  // namespace kinetix::model
