#include <gtest/gtest.h>

#include "model/closure/drive_theta.hpp"
#include "model/elastic/newton.hpp"
#include "model/lattice/square/structure.hpp"
#include "model/tolerance/print_equilibria.hpp"
#include "model/tolerance/print_runs.hpp"
#include "tests/support/elastic_equilibrium.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

constexpr double tilt = 0.2;   // rad, of rows of hinges: the sheet bends
constexpr double turn = 0.35;  // rad, of the driven hinge
// Standard deviations of a usual printer: fraction, rad, rad, cell edges.
constexpr HingeScatter print_scatter{0.004, 0.003, 0.004, 0.002};

struct BentSheet {
  Structure structure = make_structure(rectangle(4, 2), {10, 0.8, 6});
  testing::Equilibrium found;

  BentSheet() {
    for (Hinge& hinge : structure.hinges)
      if (hinge.wall.axis == Axis::x)
        hinge.parameters.beta = starts_in_sublattice_b(hinge.wall) ? -tilt : tilt;
    found =
        testing::equilibrium(structure, {}, testing::hinge_drive(structure, {{0, 0}, Axis::y}, turn), false);
  }

  PrintRuns prints(int count, const ToleranceOptions& options = {}) const {
    std::vector<ObservedPoint> points;
    for (int k = 0; k < static_cast<int>(found.state.size()); ++k)
      points.push_back({{k}, found.state[k].p, Vector3d(std::sin(k), 0.3, std::cos(k)).normalized(), 0});
    const SettledDesign design(structure, {found.state, found.elasticity, drive_on(structure, found.drive)},
                               false);
    return print_runs([&](const Eigen::Matrix4Xd& errors) { return printed(errors); }, design, points,
                      print_scatter, count, options);
  }

  Linkage printed(const Eigen::Matrix4Xd& errors) const {
    Structure s = structure;
    for (Eigen::Index h = 0; h < errors.cols(); ++h) {
      HingeParameters& p = s.hinges[h].parameters;
      p = {p.t + errors(0, h), p.alpha + errors(1, h), p.beta + errors(2, h), p.offset + errors(3, h)};
    }
    return s;
  }
};

TEST(PrintRuns, EndWhereTheyAreToldTo) {
  const BentSheet sheet;
  ASSERT_TRUE(sheet.found.found);
  int asked = 0;
  const PrintRuns some = sheet.prints(50, {.stop = [&] { return ++asked > 5; }});
  ASSERT_GT(some.prints, 0);
  ASSERT_LT(some.prints, 5);
  EXPECT_EQ(some.failed, 0);
  const PrintRuns first = sheet.prints(some.prints);
  EXPECT_EQ(some.prints, first.prints);
  EXPECT_DOUBLE_EQ(some.rms_mm, first.rms_mm);
  EXPECT_GT(first.rms_mm, 0);
}

TEST(PrintRuns, AreTheSameForAnyNumberOfThreads) {
  const BentSheet sheet;
  const PrintRuns one = sheet.prints(70);  // more than are found at once
  ASSERT_EQ(one.prints, 70);
  for (const int threads : {2, 3}) {
    const PrintRuns many = sheet.prints(70, {.threads = threads});
    EXPECT_EQ(many.prints, one.prints);
    EXPECT_EQ(many.rms_mm, one.rms_mm);
    EXPECT_EQ(many.p95_mm, one.p95_mm);
  }
}

TEST(PrintRuns, AreNoneOfARunThatIsToldToStopAtOnce) {
  const PrintRuns none = BentSheet().prints(50, {.stop = [] { return true; }});
  EXPECT_EQ(none.prints + none.failed, 0);
  EXPECT_TRUE(std::isnan(none.rms_mm));
}

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
  EXPECT_TRUE(starts.need_guidance());
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
