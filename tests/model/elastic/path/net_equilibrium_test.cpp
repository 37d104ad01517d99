#include <gtest/gtest.h>

#include "tests/support/elastic_runs.hpp"
#include "tests/support/random_nets.hpp"

namespace kinetix::model {
namespace {

using namespace testing;
using testing::hinge_drive;
using Stop = EquilibriumPath::Stop;

EquilibriumPath path_of(const Structure& net, const Drive& drive, double k_turn) {
  return trace_equilibrium(driven(net, drive), {.k_turn = k_turn}, without_contact());
}

TEST(NetEquilibrium, OfACubeBetweenPlatesIsTheClosedFormButForTheStiffnessRatio) {
  const Structure net = cube_net(60 * radians_per_degree);
  for (const double theta : {0.4, -0.4}) {
    const Drive drive = drive_to(net, theta);
    ASSERT_EQ(std::get<Plates>(drive).grip, (Grip{{3, 3}, {5, 5}}));
    const EquilibriumPath soft = path_of(net, drive, 0.1), stiff = path_of(net, drive, 1e-3);
    EXPECT_EQ(soft.stop, Stop::reached) << soft.why;
    EXPECT_EQ(stiff.stop, Stop::reached) << stiff.why;
    EXPECT_LE(from_closed_form(net, soft), 1e-2);
    EXPECT_NEAR(from_closed_form(net, soft) / from_closed_form(net, stiff), 100, 10);
  }
}

TEST(NetEquilibrium, IsTheSameByADrivenHinge) {
  const Structure net = cube_net(50 * radians_per_degree);
  const EquilibriumPath path = path_of(net, hinge_drive(net, {{4, 4}, Axis::y}, 0.4), 1e-3);
  EXPECT_EQ(path.stop, Stop::reached) << path.why;
  EXPECT_LE(from_closed_form(net, path), 1e-4);
}

TEST(NetEquilibrium, OfAFishboneFollowsTheClosedFormBySpine) {
  const Structure net = fishbone(2, 9, 0.2);
  const Drive drive = drive_to(net, 0.4);
  ASSERT_EQ(std::get<Plates>(drive).grip, (Grip{{2, 0}, {3, 9}}));
  const EquilibriumPath path = path_of(net, drive, 1e-3);
  EXPECT_EQ(path.stop, Stop::reached) << path.why;
  EXPECT_LE(from_closed_form(net, path), 1e-3);
}

TEST(NetEquilibrium, IsOnTheBranchOfTheDriveThoughTheNetLeansToOneSide) {
  constexpr unsigned seed = 17;
  std::mt19937 random(seed);
  int gripped = 0;
  for (int k = 0; k < 12; ++k) {
    const Structure net = random_net(20, random);
    for (const double theta : {0.4, -0.4}) {
      const Drive drive = drive_to(net, theta);
      if (const auto* plates = std::get_if<Plates>(&drive); !plates || !plates->grip) continue;
      const EquilibriumPath path = path_of(net, drive, 1e-3);
      EXPECT_EQ(path.stop, Stop::reached) << "seed " << seed << ", net " << k << ": " << path.why;
      EXPECT_LE(from_closed_form(net, path), 1e-3) << "seed " << seed << ", net " << k;
      ++gripped;
    }
  }
  EXPECT_GE(gripped, 8) << "seed " << seed;
}

}  // namespace
}  // namespace kinetix::model
