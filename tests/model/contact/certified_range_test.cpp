#include "model/contact/certified_range.hpp"

#include <gtest/gtest.h>
#include <cmath>

#include "model/base/invalid_input.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "tests/support/bad_input.hpp"
#include "tests/support/creased.hpp"
#include "tests/support/random_designs.hpp"
#include "tests/support/random_nets.hpp"

namespace kinetix::model {
namespace {

using testing::random_design;
using testing::structure_of;

ContactRange certified(const Lattice& sheet, const CertifiedOptions& options = {}) {
  return certified_range(sheet, exact_motion(sheet), turn_laws(sheet), options);
}

/// Every pair of plates of different bodies and walls but those that touch when flat, without a broad phase.
std::vector<WallPair> overlaps_of(const Lattice& sheet, double theta) {
  const Linkage linkage = sheet;
  const State state = exact_motion(sheet).at(theta);
  const std::vector<HalfWall> walls = half_walls(linkage);
  const std::vector<WallPair> at_rest = WallContact(linkage).touching_at_rest();
  std::vector<WallPair> found;
  for (int a = 0; a < static_cast<int>(walls.size()); ++a)
    for (int b = a + 1; b < static_cast<int>(walls.size()); ++b) {
      if (walls[a].body == walls[b].body || walls[a].hinge == walls[b].hinge) continue;
      if (std::binary_search(at_rest.begin(), at_rest.end(), WallPair{a, b})) continue;
      if (overlap(placed(walls[a], state[walls[a].body]), placed(walls[b], state[walls[b].body]), 1e-9))
        found.push_back({a, b});
    }
  return found;
}

/// Checks that there is no overlap at many thetas within the range and one at its witness, both within 1 %.
void expect_proven(const Lattice& sheet, const std::string& what, int samples = 300) {
  const ContactRange range = certified(sheet);
  ASSERT_TRUE(range) << what << ": " << range.why_not;
  for (const ContactLimit* end : {&range.negative, &range.positive}) {
    for (int k = 0; k <= samples; ++k)
      ASSERT_TRUE(overlaps_of(sheet, end->theta * k / samples).empty())
          << what << " at " << end->theta * k / samples;
    if (!end->touches) continue;
    ASSERT_TRUE(end->contact) << what;
    EXPECT_FALSE(overlaps_of(sheet, *end->contact).empty()) << what;
    EXPECT_GE(std::abs(end->theta), 0.99 * std::abs(*end->contact)) << what;
    EXPECT_LE(std::abs(end->theta), std::abs(*end->contact)) << what;
  }
}

TEST(CertifiedRange, OfBasicCellsEndsAtTheClosedForm) {
  for (const double thickness : {0.1, 0.8, 2.0, 4.0})
    for (const auto& [columns, rows] : {std::pair{1, 1}, {1, 3}, {3, 3}}) {
      const ContactRange range = certified(make_structure(rectangle(columns, rows), {10, thickness, 6}));
      const double closed = std::atan(1 - thickness / 10);
      for (const ContactLimit& end : {range.negative, range.positive}) {
        EXPECT_LE(std::abs(end.theta), closed);
        EXPECT_GE(std::abs(end.theta), closed - 3e-7);
        ASSERT_TRUE(end.contact);
        EXPECT_GE(std::abs(*end.contact), closed - 1e-9);
      }
      EXPECT_LT(range.negative.theta, range.positive.theta);
    }
}

/// Tips of walls grown by g on all sides meet at tan(theta) = (L - w - 2 g) / (L + 2 g).
TEST(CertifiedRange, OfGrownWallsEndsAtTheClosedForm) {
  for (const double growth : {0.05, 0.2, 0.6}) {
    const ContactRange range = certified(make_structure({{0, 0}}, {10, 0.8, 6}), {.growth_mm = growth});
    const double closed = std::atan((10 - 0.8 - 2 * growth) / (10 + 2 * growth));
    EXPECT_LE(range.positive.theta, closed);
    EXPECT_GE(range.positive.theta, closed - 3e-7);
  }
}

void expect_random_sheets_proven(int of_each_kind) {
  std::mt19937 random(85);
  for (int k = 0; k < of_each_kind; ++k) {
    for (const Family family : {Family::F1, Family::F2, Family::F3})
      expect_proven(structure_of(random_design(family, 3, 2, random)), to_string(family) + " seed 85");
    expect_proven(structure_of(random_design(Family::F2, 12, 1, random)), "strip, seed 85");
    expect_proven(testing::random_net(8, random), "net, seed 85");
  }
}

TEST(CertifiedRange, OfRandomSheetsIsFreeInEverySampleAndEndsAtAWitness) {
  expect_random_sheets_proven(1);
  expect_proven(testing::creased_rhombi(3, 3, 1.2), "rhombi");
  expect_proven(make_sodalite({1, 1, 1}, 0.2, {10, 0.8, 1}), "sodalite", 40);
}

TEST(CertifiedRangeSoak, OfRandomSheetsIsFreeInEverySampleAndEndsAtAWitness) {
  expect_random_sheets_proven(4);
}

/// Returns a strip of alternately bending and shearing columns, which rolls up to a helix.
Structure helix(int columns, double tilt_deg, double t) {
  auto design = ExactDesign<double>::basic(columns, 1);
  for (int c = 0; c < columns; ++c) {
    if (c % 2 == 0) design.beta[c] = tilt_deg * radians_per_degree;
    if (c % 2 == 1) design.t[c] = t;
  }
  return structure_of(design, {10, 0.8, 2});
}

/// The turns of a helix brush past each other within a degree of theta, so that samples a degree apart see nothing
/// until walls meet that close it for good.
TEST(CertifiedRange, SeesTurnsOfAHelixThatBrushPastEachOtherBetweenSamples) {
  for (const auto& [columns, tilt_deg, t] : {std::tuple{24, 35, 0.35}, {24, 45, 0.3}, {14, 40, 0.35}}) {
    const Structure s = helix(columns, tilt_deg, t);
    const ContactRange sampled = theta_range(s, exact_motion(s));
    const ContactRange proven = certified(s);
    ASSERT_TRUE(proven.positive.contact);
    EXPECT_GT(sampled.positive.theta, *proven.positive.contact + 1 * radians_per_degree);
    EXPECT_FALSE(overlaps_of(s, *proven.positive.contact).empty());
    EXPECT_TRUE(overlaps_of(s, proven.positive.theta).empty());
    const auto fine = theta_range(s, exact_motion(s), {.step = 1e-3});
    EXPECT_NEAR(proven.positive.theta, fine.positive.theta, 1e-6);
  }
}

TEST(CertifiedRange, NamesTheWallTipsThatMeet) {
  const Structure s = make_structure({{0, 0}}, {});
  const ContactRange range = certified(s);
  const auto axis = [&](int plate) { return s.hinges[half_walls(s)[plate].hinge].wall.axis; };
  EXPECT_EQ(axis(range.positive.walls.first), Axis::x);
  EXPECT_EQ(axis(range.positive.walls.second), Axis::x);
  EXPECT_EQ(axis(range.negative.walls.first), Axis::y);
  EXPECT_EQ(&range.to(-0.1), &range.negative);
}

TEST(CertifiedRange, StopsAtTheLimitOfTheSearch) {
  const ContactRange range = certified(make_structure({{0, 0}}, {}), {.limit = 0.3});
  EXPECT_EQ(range.positive.theta, 0.3);
  EXPECT_EQ(range.negative.theta, -0.3);
  EXPECT_FALSE(range.positive.touches);
}

// Tips of these walls reach just to the walls next to them, or into them.
TEST(CertifiedRange, LeavesOutPlatesThatTouchWhenBuiltAndIsEmptyWhereTheyOverlap) {
  Structure s = make_structure(rectangle(2, 1), {});
  const auto with_tips = [&](double part) {
    for (Hinge& h : s.hinges) h.parameters.t = h.wall.from.is_in_sublattice_a() ? part : 1 - part;
    return certified(s);
  };
  const ContactRange touching = with_tips(1 - s.size.thickness_mm / s.size.edge_mm / 2);
  EXPECT_EQ(touching.touching_at_rest, WallContact(s).touching_at_rest());
  EXPECT_FALSE(touching.touching_at_rest.empty());
  EXPECT_FALSE(touching.overlaps_as_built());
  const ContactRange overlapping = with_tips(0.97);
  EXPECT_TRUE(overlapping);
  EXPECT_TRUE(overlapping.overlaps_as_built());
  EXPECT_EQ(overlapping.negative.theta, 0);
  EXPECT_EQ(overlapping.positive.theta, 0);
  const WallPair found = *WallContact(s).overlap_at_rest();
  EXPECT_EQ(overlapping.positive.walls, found);
  const Linkage linkage = s;
  const State flat = rest_state(linkage);
  const std::vector<HalfWall> walls = half_walls(linkage);
  const auto box = [&](int wall) { return placed(walls[wall], flat[walls[wall].body]); };
  EXPECT_TRUE(overlap(box(found.first), box(found.second), 0.01));
}

TEST(CertifiedRange, OfWallsThatGrowIntoEachOtherWhenFlatIsEmpty) {
  Structure s = make_structure(rectangle(2, 1), {});
  for (Hinge& h : s.hinges) h.parameters.t = h.wall.from.is_in_sublattice_a() ? 0.9 : 0.1;
  EXPECT_GT(certified(s).positive.theta, 0.1);
  const ContactRange grown = certified(s, {.growth_mm = 0.5});
  EXPECT_EQ(grown.positive.theta, 0);
  EXPECT_TRUE(grown.positive.contact);
}

TEST(CertifiedRange, CertifiesNothingWithoutAClosedForm) {
  Structure s = make_structure(rectangle(2, 2), {});
  s.hinges[0].parameters.beta = 0.3;
  const ContactRange range = certified_range(s, exact_motion(s), {});
  EXPECT_FALSE(range);
  EXPECT_NE(range.why_not.find("no exact family"), std::string::npos) << range.why_not;
  EXPECT_EQ(range.positive.theta, 0);
}

TEST(CertifiedRange, CertifiesNothingWhereHingesTurnOtherwise) {
  const Structure s = make_structure(rectangle(2, 2), {});
  std::vector<TurnLaw> laws = turn_laws(s);
  laws[3].p = 0.9;
  const ContactRange range = certified_range(s, exact_motion(s), laws);
  EXPECT_FALSE(range);
  EXPECT_EQ(range.why_not,
            "the hinge on wall " + to_string(s.hinges[3].wall) + " does not turn as its family has it");
  EXPECT_EQ(range.positive.theta, 0);
  EXPECT_EQ(range.negative.theta, 0);
}

/// Two panels side by side, as one linkage without a hinge between them.
TEST(CertifiedRange, CertifiesNothingOfPartsThatNoHingesJoin) {
  const Structure s = make_structure(rectangle(1, 1), {});
  Linkage two = s;
  const int bodies = static_cast<int>(two.bodies.size()), hinges = static_cast<int>(two.hinges.size());
  for (int b = 0; b < bodies; ++b) two.bodies.push_back(two.bodies[b]);
  for (int h = 0; h < hinges; ++h) {
    RestHinge hinge = two.hinges[h];
    hinge.lower += bodies;
    hinge.upper += bodies;
    two.hinges.push_back(hinge);
  }
  for (int k = 0; k < 2 * hinges; ++k) {
    Plate plate = two.plates[k];
    plate.body += bodies;
    plate.hinge += hinges;
    two.plates.push_back(plate);
  }
  two.vertex_name = [](int body) { return std::to_string(body); };
  ExactMotion exact = exact_motion(s);
  exact.at = [at = exact.at](double theta) {
    State state = at(theta);
    for (int b = 0; b < 4; ++b) {
      Pose beside = state[b];
      beside.p.x() += 30 - 20 * std::abs(theta);
      state.push_back(beside);
    }
    return state;
  };
  const ContactRange range = certified_range(two, exact, usual_turn_laws(two));
  EXPECT_EQ(range.why_not, "no hinges join the body at 4 to the others");
}

TEST(CertifiedRange, EndsWithTheMotion) {
  const Structure s = make_structure({{0, 0}}, {});
  ExactMotion broken = exact_motion(s);
  broken.at = [at = broken.at](double theta) { return at(theta > 0.3 ? std::nan("") : theta); };
  const ContactRange range = certified_range(s, broken, turn_laws(s));
  EXPECT_LE(range.positive.theta, 0.3);
  EXPECT_GE(range.positive.theta, 0.2);
  EXPECT_FALSE(range.positive.touches);
  EXPECT_TRUE(range.negative.touches);
}

TEST(CertifiedRange, RefusesOptionsOutOfRange) {
  const Structure s = make_structure({{0, 0}}, {});
  EXPECT_THROW(certified(s, {.limit = 2}), InvalidInput);
  EXPECT_THROW(certified(s, {.precision = std::nan("")}), InvalidInput);
  EXPECT_THROW(certified(s, {.growth_mm = -1}), InvalidInput);
  EXPECT_THROW(certified(s, {.max_states = 0}), InvalidInput);
}

TEST(CertifiedRange, EndsWithoutAWitnessWhereItMayLookNoFurther) {
  const ContactRange range = certified(make_structure({{0, 0}}, {}), {.max_states = 10});
  EXPECT_TRUE(range.positive.touches);
  EXPECT_LE(range.positive.theta, std::atan(0.92));
}

}  // namespace
}  // namespace kinetix::model
