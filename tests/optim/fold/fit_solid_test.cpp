#include "optim/fold/fit_solid.hpp"

#include <gtest/gtest.h>

#include "model/contact/wall_contact.hpp"
#include "model/lattice/planar/planar_motion.hpp"

namespace kinetix::optim {
namespace {

class Solids : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Fit, Solids, ::testing::Range(0, static_cast<int>(targets::solid_names().size())),
                         [](const auto& run) { return targets::solid_names()[run.param]; });

TEST_P(Solids, FoldWithNoWallInTheWay) {
  const SolidDesign design = fit_solid(targets::named_solid(GetParam()), 2, 0, {});
  ASSERT_TRUE(design.folds);
  for (std::size_t c = 0; c < design.net.creases.size(); ++c) {
    EXPECT_NEAR(to_degrees(design.error.fold[c] - design.net.creases[c].angle), 0, 1e-6);
    EXPECT_LE(design.tilt[c], FoldOptions{}.tilt + 1e-12);
  }
  EXPECT_LE(design.error.rms, 1e-9);
  const auto limit =
      theta_range(design.net.structure, exact_motion(design.net.structure), {.limit = design.theta}).positive;
  EXPECT_FALSE(limit.touches);
}

}  // namespace
}  // namespace kinetix::optim
