#include "model/elastic/path/closed_form.hpp"

#include <gtest/gtest.h>

#include "tests/support/elastic_runs.hpp"

namespace kinetix::model {
namespace {

using namespace testing;

constexpr double driven_theta = 0.3;  // rad, of the drives below

class ClosedFormOfASheet : public ::testing::Test {
 protected:
  ElasticSystem under(const Drive& drive) const {
    return {sheet_, {}, drive_on(sheet_, drive), false, false};
  }

  const Structure sheet_ = make_structure(rectangle(3, 2), {});
  const ExactMotion exact_ = exact_motion(sheet_);
};

TEST_F(ClosedFormOfASheet, IsWhereItsDriveHoldsIt) {
  for (const Drive& drive : {plates_drive(Axis::y, driven_theta), plates_drive(Axis::x, -driven_theta),
                             hinge_drive(sheet_, {{0, 0}, Axis::y}, driven_theta)}) {
    const ElasticSystem system = under(drive);
    const State state = *ClosedForm(system, exact_).at(driven_theta);
    State placed = state;
    system.place(driven_theta, placed);
    EXPECT_LE(aligned_distance(sheet_, state, fold(classify(sheet_), sheet_, driven_theta)).rms, 1e-12);
    for (std::size_t b = 0; b < state.size(); ++b) EXPECT_EQ(state[b].p, placed[b].p);
  }
}

TEST_F(ClosedFormOfASheet, IsNearUpToAHundredthOfARadian) {
  const ElasticSystem system = under(plates_drive(Axis::y, driven_theta));
  const ClosedForm closed_form(system, exact_);
  const State state = *closed_form.at(driven_theta);
  EXPECT_TRUE(closed_form.is_near(state, driven_theta + 0.004));
  EXPECT_NEAR(*closed_form.distance(state, driven_theta + 0.004), 0.008, 1e-12) << "hinges turn by 2 theta";
  EXPECT_FALSE(closed_form.is_near(state, driven_theta + 0.006));
}

TEST_F(ClosedFormOfASheet, OfTheOtherSideIsMirroredBetweenPlatesAlone) {
  const ElasticSystem plates = under(plates_drive(Axis::y, driven_theta));
  const ElasticSystem hinge = under(hinge_drive(sheet_, {{0, 0}, Axis::y}, driven_theta));
  const ClosedForm between_plates(plates, exact_), by_hinge(hinge, exact_);
  EXPECT_TRUE(between_plates.is_mirrored(*between_plates.at(-driven_theta), driven_theta));
  EXPECT_FALSE(between_plates.is_mirrored(*between_plates.at(driven_theta), driven_theta));
  EXPECT_FALSE(by_hinge.is_mirrored(*by_hinge.at(-driven_theta), driven_theta));
}

TEST_F(ClosedFormOfASheet, IsNoneWhereNoneIsKnown) {
  const ElasticSystem system = under(plates_drive(Axis::y, driven_theta));
  const ExactMotion none;
  const ClosedForm closed_form(system, none);
  EXPECT_FALSE(closed_form.at(driven_theta));
  EXPECT_FALSE(closed_form.is_near(rest_state(sheet_), 0));
  EXPECT_FALSE(closed_form.is_mirrored(rest_state(sheet_), 0));
}

}  // namespace
}  // namespace kinetix::model
