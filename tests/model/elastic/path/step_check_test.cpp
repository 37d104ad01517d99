#include "model/elastic/path/step_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "model/contact/wall_contact.hpp"
#include "model/lattice/planar/planar_drive.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/planar_graphs.hpp"
#include "tests/support/random_elastic.hpp"

namespace kinetix::model {
namespace {

/// Two of its walls are tip to tip during the motion, and a snap would take one across the other.
TEST(EquilibriumPath, NeverHasWallsThatCrossEachOther) {
  CellSize size;
  size.thickness_mm = 0.4;
  const PlanarStructure panel = make_planar_structure({&octagon_lattice, lattice_cells(3, 3), 0, true}, size);
  const DrivenLinkage driven{panel, plate_drive(panel, Axis::y, 0.1339746, 1), exact_motion(panel)};
  ContactModel walls(panel, true);
  const State flat = rest_state(panel);
  int steps = 0;
  trace_equilibrium(driven, {.k_turn = 10}, {}, [&](const EquilibriumStep& step, const State& state) {
    EXPECT_FALSE(walls.newly_cross(flat, state)) << "theta " << step.theta;
    ++steps;
  });
  EXPECT_GE(steps, 10);
}

/// Pairs of half walls that are in each other by half a thickness or more, apart from those that touch in the flat state.
std::vector<WallPair> deep_in_each_other(const Linkage& sheet, const std::vector<WallPair>& at_rest,
                                         const State& state) {
  const std::vector<HalfWall> walls = half_walls(sheet);
  std::vector<WallPair> found = WallContact(sheet).overlapping(state);
  std::erase_if(found, [&](const WallPair& pair) {
    const HalfWall &a = walls[pair.first], &b = walls[pair.second];
    return std::find(at_rest.begin(), at_rest.end(), pair) != at_rest.end() ||
           !overlap(placed(a, state[a.body]), placed(b, state[b.body]), sheet.size.thickness_mm / 2);
  });
  return found;
}

/// The walls of each column lean towards each other. Their upper edges meet before a tendon has pulled the strip's ends
/// together. Walls of the random panels meet in any way.
TEST(EquilibriumPath, OfASheetInSpaceNeverHasWallsDeepInEachOther) {
  const double tilt = 40 * radians_per_degree;
  std::vector<DrivenLinkage> sheets;
  const Structure strip = testing::alternating(8, 1, {.beta = tilt}, {.beta = -tilt});
  const std::vector<int> through = {*strip.hinge_at({{0, 0}, Axis::x}), *strip.hinge_at({{7, 1}, Axis::x})};
  sheets.push_back({strip, cord_drive(strip, through, 60, 1), exact_motion(strip)});
  std::mt19937 random(3);
  for (int k = 0; k < 8; ++k) {
    Structure panel = testing::random_panel(4, 1 + k % 2, random);
    sheets.push_back({panel, drive_on(panel, drive_to(panel, 0.7)), exact_motion(panel)});
  }
  int in_contact = 0;
  for (const DrivenLinkage& driven : sheets) {
    const auto at_rest = WallContact(driven.linkage).touching_at_rest();
    trace_equilibrium(driven, {.k_point = 1000, .k_turn = 0.1, .k_contact = 5000}, {},
                      [&](const EquilibriumStep& step, const State& state) {
                        EXPECT_TRUE(deep_in_each_other(driven.linkage, at_rest, state).empty())
                            << "theta " << step.theta;
                        in_contact += step.contacts > 0;
                      });
  }
  EXPECT_GE(in_contact, 20);
}

}  // namespace
}  // namespace kinetix::model
