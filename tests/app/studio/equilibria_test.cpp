#include <gtest/gtest.h>

#include "app/studio/messages/templates.hpp"
#include "app/studio/play/equilibria.hpp"
#include "app/studio/play/shape.hpp"
#include "model/closure/closure.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/linkage/linkage_drive.hpp"

namespace kinetix::testing {
namespace {

using app::studio::Equilibria;
using app::studio::KnownEquilibria;

constexpr double deg = radians_per_degree;  // rad: thetas of the tests are in degrees

const auto ignore_state = [](const model::DrivenState&) {};

TEST(StudioEquilibria, GoesOnFromWhereItCameToAndEndsAsFromFlat) {
  const app::Design design = app::studio::template_design("strip");
  const Equilibria equilibria(design, app::studio::Moving(design));
  std::string why;
  const auto first = equilibria.trace_to(12 * deg, nullptr, {}, ignore_state, why);
  ASSERT_EQ(why, "");
  model::DrivenState last;
  int states = 0;
  const auto longer = equilibria.trace_to(
      20 * deg, first, {}, [&](const model::DrivenState& at) { last = at, ++states; }, why);
  ASSERT_EQ(why, "");
  EXPECT_EQ(longer->states.size(), first->states.size() + static_cast<std::size_t>(states) - 1);
  EXPECT_NEAR(last.step.theta, 20 * deg, 1e-6);
  const auto anew = equilibria.trace_to(20 * deg, nullptr, {}, ignore_state, why);
  EXPECT_LE(turn_distance(design.structure, last.state, anew->states.back().state), 1e-5);
  EXPECT_NEAR(last.step.load, anew->states.back().step.load, 1e-4 * std::abs(anew->states.back().step.load));
}

TEST(StudioEquilibria, ComesBackWithoutAWayFromFlat) {
  const app::Design design = app::studio::template_design("strip");
  const Equilibria equilibria(design, app::studio::Moving(design));
  std::string why;
  const auto known = equilibria.trace_to(20 * deg, nullptr, {}, ignore_state, why);
  model::DrivenState last;
  int states = 0;
  EXPECT_EQ(equilibria.trace_to(
                7 * deg, known, {}, [&](const auto& at) { last = at, ++states; }, why),
            known);
  EXPECT_EQ(states, 2) << "the nearest one known, and the one asked for";
  EXPECT_NEAR(last.step.theta, 7 * deg, 1e-6);
}

/// The drive that folds a strip: one hinge, a tendon, or springs.
enum class Moved { by_hinge, by_cord, by_springs };

app::Design driven(Moved moved) {
  app::Design design = app::studio::template_design("strip");
  const auto wall = [&](int column) {
    return *design.structure.squares()->hinge_at({{column, 0}, model::Axis::y});
  };
  if (moved == Moved::by_hinge) design.drive = model::HingeTurn{wall(6), 40 * deg};
  if (moved == Moved::by_cord) design.drive = model::CordPull{{wall(0), wall(12)}, 10};
  if (moved == Moved::by_springs) design.drive = model::ShapeMemory{.angle = 40 * deg, .k_turn = 5};
  return design;
}

TEST(StudioEquilibria, GoesUnderTheDesignsOwnDrive) {
  for (const Moved moved : {Moved::by_hinge, Moved::by_cord, Moved::by_springs}) {
    SCOPED_TRACE(static_cast<int>(moved));
    const app::Design design = driven(moved);
    const model::LinkageDrive drive = app::studio::drive_to(design, 15 * deg);
    const Equilibria equilibria(design, app::studio::Moving(design));
    std::string why;
    const auto first = equilibria.trace_to(10 * deg, nullptr, {}, ignore_state, why);
    model::DrivenState last;
    equilibria.trace_to(
        15 * deg, first, {}, [&](const auto& at) { last = at; }, why);
    ASSERT_EQ(why, "");
    EXPECT_NEAR(last.step.theta, 15 * deg, 1e-6);
    const auto anew = equilibria.trace_to(15 * deg, nullptr, {}, ignore_state, why);
    EXPECT_LE(turn_distance(design.structure, last.state, anew->states.back().state), 1e-5);
    const model::Linkage linkage = design.structure;
    const double load = last.step.load, force = equilibria.force_N(last.step.theta, load);
    EXPECT_GT(std::abs(load), 0);
    if (moved == Moved::by_hinge) {
      EXPECT_EQ(force, load / linkage.size.edge_mm) << "at a lever of a cell edge";
      EXPECT_NEAR(hinge_turn(linkage, last.state, drive.hinge), drive.angle, 1e-9);
    } else if (moved == Moved::by_cord) {
      EXPECT_EQ(force, load);
      EXPECT_NEAR(cord_length(linkage, drive.through, last.state), drive.rest_mm - drive.shorten_mm, 1e-6);
    } else {
      EXPECT_EQ(force, 0) << "springs need nobody";
      EXPECT_GT(mean_theta(linkage, last.state), 5 * deg);
    }
  }
}

TEST(StudioEquilibria, StopsOnItsWayWhenItIsTold) {
  const app::Design design = app::studio::template_design("strip");
  const Equilibria equilibria(design, app::studio::Moving(design));
  std::stop_source source;
  std::string why;
  const auto known = equilibria.trace_to(
      20 * deg, nullptr, source.get_token(),
      [&](const model::DrivenState& at) {
        if (at.step.theta > 5 * deg) source.request_stop();
      },
      why);
  EXPECT_LT(known->states.back().step.theta, 15 * deg);
  EXPECT_NE(why.find("it was stopped"), std::string::npos) << why;
}

}  // namespace
}  // namespace kinetix::testing
