#include "benchmarks/speed_error/exact_points.hpp"

#include <gtest/gtest.h>

#include "tests/support/random_designs.hpp"
#include "tests/support/random_nets.hpp"

namespace kinetix::bench {
namespace {

SpeedErrorScene scene_of(const model::Structure& structure, double theta) {
  SpeedErrorScene scene{"some", structure, drive_to(structure, theta), classify(structure), {}};
  scene.reference = fold(scene.family, structure, theta);
  return scene;
}

TEST(RoundingError, IsThatOfDoubleOnSheetsAndNets) {
  auto sheet = model::ExactDesign<double>::basic(12, 9);
  for (int c = 0; c < 12; ++c) sheet.beta[c] = (c % 2 ? -1 : 1) * 0.1 * (1 + c % 3);
  for (const model::Structure& s : {testing::structure_of(sheet), testing::cube_net(0.9)}) {
    const double error = rounding_error(scene_of(s, 0.5));
    EXPECT_LE(error, 1e-13);
    EXPECT_GT(error, 0);
  }
}

TEST(RoundingError, SeesAStateThatIsOff) {
  SpeedErrorScene scene = scene_of(testing::cube_net(0.9), 0.5);
  const double moved = 1e-6 * scene.structure.size.edge_mm;
  scene.reference[3].p.x() += moved;
  const double bodies = static_cast<double>(scene.reference.size());
  EXPECT_NEAR(rounding_error(scene), 1e-6 / std::sqrt(bodies), 1e-7 / std::sqrt(bodies));
}

}  // namespace
}  // namespace kinetix::bench
