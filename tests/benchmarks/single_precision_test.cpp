#include <gtest/gtest.h>

#include "model/lattice/lattice_motion.hpp"
#include "sim/physics_run.hpp"
#include "tests/support/random_designs.hpp"

namespace kinetix::bench {
namespace {

TEST(SinglePrecisionRun, EndsAtTheClosedFormAsFarAsItsNumbersGo) {
  auto design = model::ExactDesign<double>::basic(6, 1);
  for (int c = 0; c < 6; ++c) design.beta[c] = (c % 2 ? -1 : 1) * 0.16;
  design.theta = 0.5;
  const model::Structure strip = testing::structure_of(design, {10, 1, 6});
  sim::PhysicsOptions options;
  options.step_s = 1.0 / 120;
  const sim::PhysicsResult run =
      run_compression(strip, drive_on(strip, drive_to(strip, design.theta)), options);
  const double rms = aligned_distance(strip, run.state, fold(design, strip)).rms;
  EXPECT_LE(rms, 1e-5);
  EXPECT_GE(rms, 1e-9) << "that is double precision";
}

}  // namespace
}  // namespace kinetix::bench
