#include "benchmarks/measured/measured_samples.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "benchmarks/measured/crossed_lattice.hpp"
#include "benchmarks/measured/measured_models.hpp"
#include "model/base/geometry.hpp"

namespace kinetix::bench {
namespace {

using ::testing::ElementsAre;

TEST(StretchSamples, HaveAllPointsOfTheirSource) {
  std::vector<std::size_t> counts;
  for (const StretchSample& sample : stretch_samples()) {
    EXPECT_EQ(sample.runs.size(), 3u) << sample.name;
    for (const auto& run : sample.runs) counts.push_back(run.size());
  }
  EXPECT_THAT(counts, ElementsAre(13, 12, 12, 6, 6, 6, 9, 9, 9, 8, 9, 9));  // 108 points
}

TEST(StretchSamples, LieNearTheExactMotionOfTheirDesigns) {
  // The figures of measured.md.
  const double rms[] = {0.0049, 0.0063, 0.0048, 0.0101}, max[] = {0.0127, 0.0098, 0.0096, 0.0229};
  for (std::size_t k = 0; k < stretch_samples().size(); ++k) {
    const StretchDeviation d = compare_stretch(stretch_samples()[k]);
    EXPECT_NEAR(d.rms, rms[k], 5e-5) << stretch_samples()[k].name;
    EXPECT_NEAR(d.max, max[k], 5e-5) << stretch_samples()[k].name;
    EXPECT_LT(d.rms, 0.012) << stretch_samples()[k].name;
  }
}

TEST(MarkerRows, HaveOneBendPerInnerMarker) {
  for (const auto& rows : {flat_rows(), dome_rows()})
    for (const MarkerRow& row : rows) EXPECT_EQ(row.bend_deg.size() + 1, row.spacing_mm.size()) << row.name;
  EXPECT_EQ(flat_rows().size() + dome_rows().size(), 11u);
}

TEST(PinLattice, HasTheSpacingsOfItsClosedForm) {
  const PinLattice lattice = read_pin_lattice();
  EXPECT_NEAR(max_spacing_mm(lattice), 44.901 + 2 * 0.2, 1e-9);
  for (const MarkerRow& row : flat_rows()) {
    double mean = 0;
    for (const double spacing : row.spacing_mm) mean += spacing / static_cast<double>(row.spacing_mm.size());
    EXPECT_NEAR(44.901 * std::cos(compare_spacings(lattice, row).theta), mean, 1e-9) << row.name;
  }
}

// Open crosses cannot turn to lengthen a row. The pulled cell moves by the play of the pins at its tips, less the rounded
// corner of the law of clearance.
TEST(CrossedLattice, WithOpenCrossesMovesByThePlayOfOnePinPerStep) {
  for (const double play : {0.01, 0.1}) {
    const PulledLattice pulled =
        pull({.side = 2, .arm_mm = 20, .spacing_mm = 40, .play_mm = play}, 1, 0, {0.1, 0});
    ASSERT_TRUE(pulled.converged);
    EXPECT_LT(pulled.moved_mm[0].norm(), 1e-9);
    EXPECT_NEAR(pulled.moved_mm[2].x(), play, 0.05 * play);
    EXPECT_NEAR(pulled.moved_mm[2].y(), 0, 0.05 * play);
  }
}

// Crosses that are turned open under the pull, as far as the play of their loops allows.
TEST(CrossedLattice, MovesFurtherWhereItsCrossesTurn) {
  const double play = 0.1;
  const PulledLattice pulled =
      pull({.side = 3, .arm_mm = 20, .spacing_mm = 30, .play_mm = play}, 2, 2, {0.1, 0.1});
  ASSERT_TRUE(pulled.converged);
  EXPECT_GT(pulled.moved_mm[8].x(), 2 * 2 * play);
  EXPECT_NEAR(pulled.moved_mm[8].x(), pulled.moved_mm[8].y(),
              1e-3);  // the lattice is symmetric about its diagonal
}

}  // namespace
}  // namespace kinetix::bench
