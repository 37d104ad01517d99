#include "model/tolerance/flat_starts.hpp"

#include <gtest/gtest.h>

#include "model/closure/drive_theta.hpp"
#include "model/elastic/newton.hpp"
#include "model/lattice/square/structure.hpp"
#include "model/tolerance/print_errors.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::model {
namespace {

using namespace testing;

constexpr int prints = 12;  // of each kind of hinge: what chance decides shows in some of them

/// Soft blocks of 1 mm as hinges.
Elasticity soft_blocks() {
  Elasticity e{3.574, 0.351, 1.732, 35.74};
  e.ratios = {1, 0.158, 0.2125};
  return e;
}

/// A strip with tilts in zigzag, as an arch has.
Structure tilted_strip() {
  Structure s = make_sheet(8, 1, {12, 1.2, 7.2});
  for (Hinge& hinge : s.hinges)
    if (hinge.wall.axis == Axis::x) hinge.parameters.beta = hinge.wall.from.j == 0 ? 0.2 : -0.2;
  return s;
}

Linkage printed_strip(const Eigen::Matrix4Xd& errors) {
  Structure s = tilted_strip();
  for (Eigen::Index h = 0; h < errors.cols(); ++h) {
    HingeParameters& at = s.hinges[static_cast<std::size_t>(h)].parameters;
    at.t += errors(0, h);
    at.alpha += errors(1, h);
    at.beta += errors(2, h);
    at.offset += errors(3, h);
  }
  return s;
}

FlatStarts starts_of(const HingeScatter& scatter, double theta, int threads = 1) {
  ToleranceOptions options;
  options.threads = threads;
  return *flat_starts(printed_strip, soft_blocks(), drive_on(tilted_strip(), plates_drive(Axis::x, theta)),
                      scatter, prints, options);
}

/// Returns theta of a print under plates that close in small steps, from equilibrium to equilibrium.
double walked_theta(const Linkage& print, const LinkageDrive& drive, double theta) {
  ElasticSystem system(print, soft_blocks(), drive, false, true);
  TangentStiffness tangent(system.dofs());
  State state = rest_state(print);
  for (int step = 1; step <= 100; ++step) {
    system.place(theta * step / 100, state);
    minimise(system, theta * step / 100, {}, state, tangent);
  }
  return mean_theta(print, state);
}

// Forces run along the walls, through the points of the hinges, wherever along the walls these are and however they lean.
TEST(FlatStarts, HaveNoPushByPlacesAndTiltsOfHinges) {
  const FlatStarts starts = starts_of({.t = 0.008, .beta = 0.01}, 0.3);
  EXPECT_EQ(starts.prints, prints);
  EXPECT_EQ(starts.either_side, prints);
  EXPECT_EQ(starts.other_side, 0);
  EXPECT_TRUE(starts.need_help());
}

TEST(FlatStarts, OfPrintsWithOffsetsGoToTheSideOfPrintsThatAreWalkedThereInSmallSteps) {
  const HingeScatter scatter{.t = 0.008, .beta = 0.01, .offset = 0.005};
  const double theta = 0.3;
  const FlatStarts starts = starts_of(scatter, theta);
  PrintErrors errors(scatter, static_cast<Eigen::Index>(tilted_strip().hinges.size()),
                     ToleranceOptions{}.seed);
  int other_side = 0;
  for (int k = 0; k < prints; ++k)
    other_side += walked_theta(printed_strip(errors.next()),
                               drive_on(tilted_strip(), plates_drive(Axis::x, theta)), theta) < 0;
  EXPECT_EQ(starts.prints, prints);
  EXPECT_EQ(starts.either_side, 0);
  EXPECT_EQ(starts.other_side, other_side);
  EXPECT_GT(other_side, 0);
  EXPECT_LT(other_side, prints);
  EXPECT_EQ(starts_of(scatter, -theta, 2).other_side, prints - other_side) << "asked for the other side";
}

TEST(FlatStarts, WithoutErrorsAreLeftToChance) { EXPECT_EQ(starts_of({}, 0.3).either_side, prints); }

TEST(FlatStarts, EndWhereTheyAreToldTo) {
  ToleranceOptions options;
  options.stop = [] { return true; };
  EXPECT_FALSE(flat_starts(printed_strip, soft_blocks(), drive_on(tilted_strip(), plates_drive(Axis::x, 0.3)),
                           {}, 2, options));
}

}  // namespace
}  // namespace kinetix::model
