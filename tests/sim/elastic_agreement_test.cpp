#include <gtest/gtest.h>

#include "model/base/invalid_input.hpp"
#include "model/elastic/equilibrium_comparison.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "model/material/manufactured_hinge.hpp"
#include "sim/physics_run.hpp"
#include "tests/sim/elastic_equilibrium.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/paper_scenes.hpp"

/// Compares the equilibrium model with the simulation. The two programs share only the numbers of the hinges and walls.
namespace kinetix::sim {
namespace {

using namespace testing;
using Outcome = model::EquilibriumComparison::Outcome;
using Status = PhysicsResult::Status;

struct Pair {
  model::EquilibriumPath path;
  PhysicsResult run;
  model::EquilibriumComparison comparison;
};

Pair both(const model::Structure& s, const model::Drive& drive, bool contact = true,
          const model::Elasticity& elasticity = {}) {
  model::EquilibriumPathOptions path_options;
  path_options.contact = contact;
  path_options.longest_step = path_options.first_step = 0.01;
  Pair pair;
  pair.path = trace_equilibrium(driven(s, drive), elasticity, path_options);
  EXPECT_EQ(pair.path.stop, model::EquilibriumPath::Stop::reached) << pair.path.why;
  PhysicsOptions options;
  options.elastic = relative(elasticity, s.size.edge_mm);
  options.planar = pair.path.planar;
  options.contact = contact;
  pair.run = run_compression(s, drive_on(s, drive), options);
  EXPECT_EQ(pair.run.status, Status::settled) << pair.run.why;
  pair.comparison = compare_equilibria({s, elasticity, drive_on(s, drive), pair.path.planar, contact},
                                       pair.run.state, pair.path.state, 1e-2);
  return pair;
}

void expect_contact_of_walls(double k, double theta) {
  const Pair pair = both(letter_panel(k, 6), plates_drive(model::Axis::y, theta));
  EXPECT_EQ(pair.comparison.outcome, Outcome::agrees) << pair.comparison.why;
  EXPECT_LE(pair.comparison.distance.rms, 5e-3);
  EXPECT_GT(pair.path.steps.back().contacts, 0);
  EXPECT_GT(pair.run.contact.depth, 2e-3);
}

TEST(ElasticAgreement, OfALetterWhoseWallsPressOnEachOther) {
  expect_contact_of_walls(0.15, 33 * radians_per_degree);
}

TEST(ElasticAgreement, OfALetterOfShortWallsThatPressOnEachOther) {
  expect_contact_of_walls(0.1, -25 * radians_per_degree);
}

TEST(ElasticAgreement, OfALetterOnBothBranches) {
  const model::Structure panel = letter_panel(0.15, 6);
  double energies[2];
  for (int side = 0; side < 2; ++side) {
    const double theta = (side ? -1 : 1) * std::acos(0.84);
    const Pair pair = both(panel, plates_drive(model::Axis::y, theta), false);
    EXPECT_LE(pair.comparison.distance.rms, 1e-4);
    EXPECT_GT(pair.run.gaps.rms, 0.03) << "the letter is not mobile: hinges stretch";
    energies[side] = elastic_energy(panel, pair.run.state, relative(model::Elasticity{}, panel.size.edge_mm));
  }
  EXPECT_NEAR(energies[0], energies[1], 1e-9 * energies[0]);
}

TEST(ElasticAgreement, OfTheGradientPanel) {
  const Pair pair = both(gradient_panel(), plates_drive(model::Axis::x, 20 * radians_per_degree));
  EXPECT_LE(pair.comparison.distance.rms, 1e-5);
}

TEST(ElasticAgreement, OfATwistingStripOnTheBarrierAndInContact) {
  const model::Structure s = twisting_strip();
  const model::Wall middle{{5, 0}, model::Axis::y};
  EXPECT_LE(both(s, hinge_drive(s, middle, 20 * radians_per_degree)).comparison.distance.rms, 1e-5);
  const Pair touching = both(s, hinge_drive(s, middle, 40 * radians_per_degree));
  EXPECT_TRUE(touching.run.contact.touches());
  EXPECT_GT(touching.path.steps.back().contacts, 0);
  EXPECT_LE(touching.comparison.distance.rms, 1e-2);
}

/// A sheet that was free to spin about the plates' normal would turn on edge and tip over, without strain.
TEST(ElasticAgreement, OfSheetsInSpaceBetweenPlates) {
  for (const model::Structure& s :
       {alternating(4, 4, twisting_unit, basic_unit), alternating(4, 4, twisting_unit, twisting_unit)})
    for (const model::Axis axis : {model::Axis::x, model::Axis::y}) {
      const Pair pair = both(s, plates_drive(axis, 35 * radians_per_degree), false);
      EXPECT_LE(pair.comparison.distance.rms, 1e-4);
      EXPECT_GT(pair.comparison.energy, 100);
    }
}

// A block of rubber and a pin, N/mm and N mm/rad: softer across the wall than along it; along its rod least of
// all.
const model::HingeStiffness block{2000, 500, 700, 0.1}, pin{2000, 1900, 300, 0.1};
constexpr double reach_mm = 1.8;

/// Returns one of the two kinds at each hinge, in turn.
model::Elasticity alternating_kinds(const model::Structure& s) {
  model::Elasticity whole = elasticity_of(block, reach_mm);
  for (std::size_t h = 0; h < s.hinges.size(); ++h)
    whole.each.push_back(elasticity_of(h % 2 == 0 ? block : pin, reach_mm));
  return whole;
}

/// @param isotropic least distance from where hinges that are as stiff in all directions take it
void expect_framed_agreement(const model::Structure& s, const model::Drive& drive, double isotropic) {
  const Pair plain = both(s, drive, false);
  for (const model::Elasticity& elasticity :
       {elasticity_of(block, reach_mm), elasticity_of(pin, reach_mm), alternating_kinds(s)}) {
    const Pair pair = both(s, drive, false, elasticity);
    EXPECT_LE(pair.comparison.distance.rms, 1e-4);
    EXPECT_GE(aligned_distance(s, pair.run.state, plain.run.state).rms, isotropic);
  }
}

TEST(ElasticAgreement, OfFramedHingesOnABentSheet) {
  expect_framed_agreement(alternating(4, 4, twisting_unit, basic_unit),
                          plates_drive(model::Axis::y, 35 * radians_per_degree), 1e-3);
}

TEST(ElasticAgreementSoak, OfFramedHingesOnABentSheet) {
  expect_framed_agreement(alternating(8, 8, twisting_unit, basic_unit),
                          plates_drive(model::Axis::y, 35 * radians_per_degree), 1e-3);
}

TEST(ElasticAgreement, OfFramedHingesOnATwistingStrip) {
  expect_framed_agreement(twisting_strip(),
                          hinge_drive(twisting_strip(), {{5, 0}, model::Axis::y}, 20 * radians_per_degree),
                          1e-3);
}

/// One hinge drives the strip in space. Nothing holds it from outside, and nothing may set it spinning as a whole.
/// Blocks of rubber that turn stiffly pull far from along their gaps.
TEST(ElasticAgreement, OfAStripOfThickBlocksThatComesToRestInSpace) {
  const model::HingeStiffness thick = model::stiffness({.kind = model::HingeKind::block,
                                                        .material = *model::find_material("tango"),
                                                        .gap_mm = 1,
                                                        .thickness_mm = 0.8,
                                                        .height_mm = 6});
  const Pair pair =
      both(twisting_strip(), hinge_drive(twisting_strip(), {{5, 0}, model::Axis::y}, 20 * radians_per_degree),
           false, elasticity_of(thick, reach_mm));
  EXPECT_LE(pair.comparison.distance.rms, 1e-3);
}

/// Springs of shape memory in the hinges of a sheet, heated in both. @return rms distance, cell edges
double heated_distance(const model::Structure& s, const std::vector<int>& hinges, double k_spring,
                       double angle) {
  const model::Elasticity elasticity;
  const model::LinkageDrive drive = shape_memory_drive(s, hinges, k_spring, angle);
  const model::EquilibriumPath path =
      trace_equilibrium({s, drive, exact_motion(s)}, elasticity, without_contact());
  EXPECT_EQ(path.stop, model::EquilibriumPath::Stop::reached) << path.why;
  PhysicsOptions options;
  options.elastic = relative(elasticity, s.size.edge_mm);
  options.spring_turn = k_spring / energy_unit(elasticity, s.size.edge_mm);
  options.planar = path.planar;
  options.contact = false;
  const PhysicsResult run = run_compression(s, drive, options);
  EXPECT_EQ(run.status, Status::settled) << run.why;
  return aligned_distance(s, run.state, path.state).rms;
}

TEST(ElasticAgreement, OfHeatedSpringsInSheetsThatMoveExactlyAndThatStrain) {
  EXPECT_LE(heated_distance(gradient_panel(), {}, 2, 30 * radians_per_degree), 1e-5);
  EXPECT_LE(heated_distance(bending_strip(), {}, 2, 40 * radians_per_degree), 1e-5);
  EXPECT_LE(heated_distance(alternating(4, 4, twisting_unit, basic_unit), {}, 20, 40 * radians_per_degree),
            1e-4);
  EXPECT_LE(
      heated_distance(alternating(4, 4, twisting_unit, basic_unit), {0, 5, 9}, 20, 40 * radians_per_degree),
      1e-4);
}

/// @return rms distance of a sheet that a tendon folds in both, cell edges
double corded_distance(const model::Structure& s, const std::vector<int>& through, double shorten_mm) {
  const model::Elasticity elasticity;
  const model::LinkageDrive drive = cord_drive(s, through, shorten_mm);
  const model::EquilibriumPath path =
      trace_equilibrium({s, drive, exact_motion(s)}, elasticity, without_contact());
  EXPECT_EQ(path.stop, model::EquilibriumPath::Stop::reached) << path.why;
  PhysicsOptions options;
  options.elastic = relative(elasticity, s.size.edge_mm);
  options.planar = path.planar;
  options.contact = false;
  const PhysicsResult run = run_compression(s, drive, options);
  EXPECT_EQ(run.status, Status::settled) << run.why;
  EXPECT_LE(run.drive_gap, 1e-3);
  return aligned_distance(s, run.state, path.state).rms;
}

/// Returns the hinges of the walls across a row of cells.
std::vector<int> across(const model::Structure& s, int row, int columns) {
  std::vector<int> through;
  for (int i = 0; i <= columns; ++i) through.push_back(*s.hinge_at({{i, row}, model::Axis::y}));
  return through;
}

TEST(ElasticAgreement, OfACordInSheetsThatMoveExactlyAndThatStrain) {
  const model::Structure basic = model::make_sheet(4, 3, {10, 0.8, 6}),
                         strained = alternating(4, 4, twisting_unit, basic_unit), bent = bending_strip();
  EXPECT_LE(corded_distance(basic, across(basic, 1, 4), 4), 1e-4);
  EXPECT_LE(corded_distance(bent, across(bent, 0, 8), 4), 1e-3);
  EXPECT_LE(corded_distance(strained, across(strained, 1, 4), 5), 1e-3);
}

}  // namespace
}  // namespace kinetix::sim
