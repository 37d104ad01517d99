#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>

#include "model/base/invalid_input.hpp"
#include "model/closure/mobility.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/lattice/square/family/classification.hpp"
#include "model/lattice/square/structure.hpp"
#include "optim/display/fit_display.hpp"
#include "optim/display/scaled_display.hpp"
#include "targets/display/display_goal.hpp"
#include "targets/display/glyph_goal.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector2d;

Vector2d middle_of(const model::PlanarStructure& panel, int hinge) {
  const auto [from, to] = panel.graph.edges[hinge];
  return (panel.graph.vertices[from] + panel.graph.vertices[to]) / 2;
}

model::ParallelDrawing none(const model::PlanarStructure& panel) {
  return model::ParallelDrawing(panel.graph.vertices.size(), Vector2d::Zero());
}

TEST(DrivenHinge, IsTheNearestToTheMiddleWhereNoWallIsScaled) {
  const model::PlanarStructure panel = planar_structure(model::make_sheet(6, 8, {}));
  const Vector2d middle = middle_of(panel, middle_hinge(panel, none(panel)));
  EXPECT_DOUBLE_EQ((middle - Vector2d(3, 4)).norm(), 0.5);
}

TEST(DrivenHinge, HasTheLeastOffsetOfTheMiddleHalf) {
  const model::PlanarStructure panel = planar_structure(model::make_sheet(8, 8, {}));
  model::ParallelDrawing y = none(panel);
  // All walls change equally. Below, one vertex off the middle moves by as much as one of its walls would.
  for (std::size_t v = 0; v < y.size(); ++v) {
    const Vector2d& x = panel.graph.vertices[v];
    y[v] = 0.1 * Vector2d(-x.y(), x.x());
  }
  const int plain = middle_hinge(panel, y);
  EXPECT_DOUBLE_EQ((middle_of(panel, plain) - Vector2d(4, 4)).norm(), 0.5);
  const auto at = [&](double i, double j) {
    for (int v = 0; v < static_cast<int>(y.size()); ++v)
      if (panel.graph.vertices[v] == Vector2d(i, j)) return v;
    return -1;
  };
  y[at(3, 5)].x() -= 0.1;  // the wall from (3, 5) to (3, 6) keeps to its midline
  const int found = middle_hinge(panel, y);
  EXPECT_NEAR(change_of(panel, y, found).o, 0, 1e-15);
  EXPECT_LE((middle_of(panel, found) - Vector2d(4, 4)).cwiseAbs().maxCoeff(), 2);
}

TEST(DrivenHinge, TurnsByTwiceTheta) {
  model::PlanarStructure panel = planar_structure(model::make_sheet(4, 4, {}));
  const model::ParallelDrawing y = none(panel);
  for (const double theta : {0.3, -0.5})
    for (int hinge = 0; hinge < static_cast<int>(panel.hinges.size()); ++hinge) {
      const model::HingeTurn turn = turn_to(panel, hinge, theta);
      EXPECT_NEAR(turn.angle, hinge_turn(panel, fold(panel, y, theta), hinge), 1e-14);
      EXPECT_NEAR(std::abs(turn.angle), 2 * std::abs(theta), 1e-15);
    }
}

using targets::DisplayScore;

// mm: walls as thick as those of the displays that ship.
constexpr model::CellSize size = {10, 0.8, 6};

targets::DisplayGoal letter(const std::string& text, int cells) {
  return glyph_goal(text, targets::find_font(targets::default_font), cells, cells);
}

// The figures of kinematics.md section 5, for the capitals that it names.
TEST(ScaledDisplay, ShowsLettersWithAllHingesClosedAndWallsApart) {
  for (const char* text : {"T", "B", "E", "S", "R", "Q"}) {
    SCOPED_TRACE(text);
    const targets::DisplayGoal goal = letter(text, 12);
    model::Structure panel = model::make_sheet(12, 12, size);
    const std::vector<double> levels = levels_of(goal, panel);
    const ScaledDisplay found = scale_display(planar_structure(panel), levels, {});
    EXPECT_TRUE(found.converged);
    EXPECT_TRUE(found.clear);
    EXPECT_LE(found.offset, 0.08 * (1 + 1e-15));
    place_hinges(found.y, panel);
    validate_hinges(panel);

    const model::Classification kind = classify(panel);
    EXPECT_EQ(kind.family, model::Family::planar) << kind.why;
    const model::State state = fold(kind, panel, found.theta);
    EXPECT_LE(hinge_gaps(panel, state).max, 1e-12);
    const DisplayScore light = targets::display_score(channel_values(Channel::light, panel, state), levels),
                       area = targets::display_score(channel_values(Channel::area, panel, state), levels),
                       flat = targets::display_score(channel_values(Channel::light, panel, rest_state(panel)),
                                                     levels);
    EXPECT_EQ(light.auc, 1);
    EXPECT_GE(area.auc, 0.99);
    EXPECT_GE(area.letter / area.rest, 1.25);
    EXPECT_EQ(flat.contrast, 0);
    constexpr double apart = 36 * radians_per_degree;
    EXPECT_GE(model::theta_range(panel, exact_motion(panel), {.limit = apart}).positive.theta, apart);

    // Plates find their rows straight, and as near as asked.
    const model::GrippedRows rows = gripped_bodies(panel, model::Axis::y);
    for (const auto& row : rows)
      for (const int b : row) EXPECT_NEAR(state[b].p.y(), state[row.front()].p.y(), 1e-11);
    EXPECT_NEAR(state[rows[1][0]].p.y() - state[rows[0][0]].p.y(), 120 * (1 - found.compression), 1e-10);
  }
}

// The ratios that kinematics.md section 5 gives for straight and for free rows.
TEST(ScaledDisplay, ShowsLettersMoreClearlyWhereRowsAreFree) {
  for (const char* text : {"T", "B", "E", "S", "R", "Q"}) {
    SCOPED_TRACE(text);
    model::Structure panel = model::make_sheet(12, 12, size);
    const std::vector<double> levels = levels_of(letter(text, 12), panel);
    constexpr double theta = 35 * radians_per_degree;
    const ScaledDisplay found = scale_display(planar_structure(panel), levels, {.free_to = theta});
    EXPECT_TRUE(found.converged);
    EXPECT_TRUE(found.clear);
    EXPECT_EQ(found.theta, theta);
    EXPECT_EQ(found.compression, 0);
    EXPECT_LE(found.offset, 0.08 * (1 + 1e-15));
    place_hinges(found.y, panel);
    const model::State state = fold(found.y, panel, theta);
    EXPECT_LE(hinge_gaps(panel, state).max, 1e-12);
    const DisplayScore light = targets::display_score(channel_values(Channel::light, panel, state), levels),
                       area = targets::display_score(channel_values(Channel::area, panel, state), levels);
    EXPECT_GE(light.auc, 0.98);
    EXPECT_GE(area.auc, 0.99);
    EXPECT_GE(area.letter / area.rest, 1.38);
  }
}

TEST(ScaledDisplay, LeavesOneWayToMove) {
  for (const ScaledDisplayOptions& options : {ScaledDisplayOptions{}, ScaledDisplayOptions{.free_to = 0.6}}) {
    model::Structure panel = model::make_sheet(8, 8, size);
    place_hinges(scale_display(planar_structure(panel), levels_of(letter("T", 8), panel), options).y, panel);
    EXPECT_EQ(model::mobility(panel, exact_motion(panel)).dofs_along, 1);
  }
}

TEST(ScaledDisplay, WorksBetweenPlatesOfEitherDirection) {
  model::Structure panel = model::make_sheet(10, 10, size);
  const std::vector<double> levels = levels_of(letter("L", 10), panel);
  for (const model::Axis axis : {model::Axis::x, model::Axis::y}) {
    const ScaledDisplay found = scale_display(planar_structure(panel), levels, {.axis = axis});
    place_hinges(found.y, panel);
    const model::State state = fold(found.y, panel, found.theta);
    const model::GrippedRows rows = gripped_bodies(panel, axis);
    const int d = axis == model::Axis::x ? 0 : 1;
    for (const auto& row : rows)
      for (const int b : row) EXPECT_NEAR(state[b].p[d], state[row.front()].p[d], 1e-11);
    EXPECT_NEAR(state[rows[1][0]].p[d] - state[rows[0][0]].p[d], 100 * (1 - found.compression), 1e-10);
    EXPECT_EQ(targets::display_score(channel_values(Channel::light, panel, state), levels).auc, 1);
  }
}

TEST(ScaledDisplay, ComesAsFarAsWallsStayApart) {
  const model::Structure panel = model::make_sheet(8, 8, {10, 2, 6});
  const std::vector<double> levels = levels_of(letter("T", 8), panel);
  const ScaledDisplay found = scale_display(planar_structure(panel), levels, {.compression = {0.1, 0.3}});
  EXPECT_GT(found.rounds, 1);
  EXPECT_LT(found.compression, 0.3);
  EXPECT_GE(found.compression, 0.1);
  EXPECT_TRUE(found.clear);
  EXPECT_LT(found.theta, found.clear_to);
}

TEST(ScaledDisplay, TheDirectionThatShowsMostIsTaken) {
  const model::Structure panel = model::make_sheet(10, 10, size);
  const std::vector<double> levels = levels_of(letter("E", 10), panel);
  const auto contrast = [&](const std::vector<model::Axis>& axes) {
    return fit_scaled_display(panel, levels, Channel::light, axes, {}).view.score.contrast;
  };
  EXPECT_EQ(contrast({model::Axis::x, model::Axis::y}),
            std::max(contrast({model::Axis::x}), contrast({model::Axis::y})));
}

TEST(ScaledDisplay, CompressionAndThetaBelongTogether) {
  for (const double compression : {0.01, 0.12, 0.3, 0.5})
    for (const double drop : {0.0, 0.15, 1.0})
      EXPECT_NEAR(compression_at(theta_of_compression(compression, drop, 12), drop, 12), compression, 1e-14);
  EXPECT_NEAR(theta_of_compression(0.5, 0, 7), std::acos(0.5), 1e-15);
}

TEST(ScaledDisplay, RefusesOptionsThatCannotBe) {
  const model::Structure panel = model::make_sheet(3, 3, size);
  const std::vector<double> levels = {0, 0, 0, 0, 1, 0, 0, 0, 0};
  const auto refused = [&](const ScaledDisplayOptions& options, const char* what) {
    try {
      scale_display(planar_structure(panel), levels, options);
      ADD_FAILURE() << what;
    } catch (const InvalidInput& e) {
      EXPECT_THAT(e.reason(), ::testing::HasSubstr(what));
    }
  };
  refused({.compression = {0, 0.1}}, "compression is 0");
  refused({.compression = {0.1, 0.6}}, "compression is 0.6");
  refused({.offset = 0}, "offset is 0");
  refused({.offset = NAN}, "offset is nan");
  refused({.t = {0.5, 0.8}}, "t is 0.5");
  refused({.drop = -1}, "drop is -1");
  refused({.free_to = 0}, "free_to is 0");
  refused({.free_to = 2}, "free_to is 2");
  refused({.free_to = NAN}, "free_to is nan");
}

}  // namespace
}  // namespace kinetix::optim
