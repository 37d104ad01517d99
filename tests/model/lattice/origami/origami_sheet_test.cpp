#include "model/lattice/origami/origami_sheet.hpp"

#include <gtest/gtest.h>

#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"
#include "model/closure/mobility.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/lattice/origami/quad_mesh.hpp"
#include "tests/support/random_mesh.hpp"

namespace kinetix::model {
namespace {

/// Facets, and how far random data may be from the Miura sheet's: larger meshes leave the range sooner.
struct MeshCase {
  int facets;
  double amount;
};

class RandomMesh : public ::testing::TestWithParam<MeshCase> {};

TEST_P(RandomMesh, FoldsClosedAtEveryTheta) {
  const auto [facets, amount] = GetParam();
  std::mt19937 random(7 + facets);
  for (int trial = 0; trial < 4; ++trial) {
    const QuadMesh mesh = testing::random_mesh(facets, facets, amount, random).mesh;
    for (const double theta : {0.02, 0.3, 0.6, 0.98, -0.5}) EXPECT_LE(fold_gap(mesh, theta), 1e-11);
  }
}

TEST_P(RandomMesh, IsASheetWhoseHingesAllStayClosed) {
  const auto [facets, amount] = GetParam();
  std::mt19937 random(70 + facets);
  const OrigamiSheet sheet = origami_sheet(testing::random_mesh(facets, facets, amount, random).mesh, {});
  EXPECT_EQ(sheet.structure.faces.size(), static_cast<std::size_t>((2 * facets - 1) * (2 * facets - 1)));
  for (const double theta : {0.02, 0.3, 0.6, 0.98, -0.5}) {
    const HingeGaps gaps = hinge_gaps(sheet.structure, fold(sheet, theta));
    EXPECT_LE(gaps.max, 1e-11) << facets << " facets, theta " << theta;
    EXPECT_LE(gaps.axis_max, 1e-7) << facets << " facets, theta " << theta;
  }
}

INSTANTIATE_TEST_SUITE_P(Facets, RandomMesh,
                         ::testing::Values(MeshCase{2, 0.2}, MeshCase{4, 0.12}, MeshCase{8, 0.06},
                                           MeshCase{12, 0.04}, MeshCase{20, 0.02}));

TEST(OrigamiSheet, HasOneDegreeOfFreedom) {
  std::mt19937 random(5);
  for (const auto& [facets, amount] : {MeshCase{2, 0.08}, MeshCase{3, 0.08}, MeshCase{4, 0.08},
                                       MeshCase{6, 0.08}, MeshCase{12, 0.04}, MeshCase{20, 0.02}}) {
    const OrigamiSheet sheet = origami_sheet(testing::random_mesh(facets, facets, amount, random).mesh, {});
    const ExactMotion exact{[&](double theta) { return fold(sheet, theta); }, "origami", ""};
    const Mobility found = mobility(sheet.structure, exact);
    EXPECT_EQ(found.verdict, Verdict::mobile) << found.why;
    EXPECT_EQ(found.dofs_along, 1) << facets << " facets";
  }
}

/// Walls of sharp sheets cross the extensions of creases.
TEST(OrigamiSheet, OfSharpSectorsStaysClosedToo) {
  for (const double angle_deg : {21, 36, 45, 48}) {
    const OrigamiSheet sheet =
        origami_sheet(march(miura(5, 4, angle_deg * radians_per_degree, 1.2)).mesh, {});
    for (const double theta : {0.02, 0.3, 0.9, -0.5}) {
      const HingeGaps gaps = hinge_gaps(sheet.structure, fold(sheet, theta));
      EXPECT_LE(gaps.max, 1e-11) << angle_deg << " deg, theta " << theta;
      EXPECT_LE(gaps.axis_max, 1e-7) << angle_deg << " deg, theta " << theta;
    }
    const ExactMotion exact{[&](double theta) { return fold(sheet, theta); }, "origami", ""};
    EXPECT_EQ(mobility(sheet.structure, exact).dofs_along, 1) << angle_deg << " deg";
  }
}

/// Plates 0.3 of a wall high, 0.08 thick.
TEST(OrigamiSheet, OfMiuraIsFreeOfCollisionsOnTheWay) {
  const OrigamiSheet sheet =
      origami_sheet(march(miura(6, 6, 80 * radians_per_degree, 2.4)).mesh, {10, 0.8, 3});
  const ContactRange range =
      theta_range(sheet.structure, [&](double theta, State& state) { state = fold(sheet, theta); },
                  {.limit = 0.6, .step = 0.5 * radians_per_degree});
  EXPECT_TRUE(range.touching_at_rest.empty());
  EXPECT_GE(range.positive.theta, 0.5);
}

TEST(OrigamiSheet, IsFoundMobileByASolverThatKnowsNoFacets) {
  std::mt19937 random(6);
  const OrigamiSheet sheet = origami_sheet(testing::random_mesh(2, 2, 0.1, random).mesh, {});
  const Mobility found = mobility(sheet.structure, {});
  EXPECT_EQ(found.verdict, Verdict::mobile) << found.why;
}

TEST(OrigamiSheet, RefusesSectorsThatLeaveNoRoomForItsBodies) {
  EXPECT_THROW(origami_sheet(march(miura(3, 3, 0.3, 1)).mesh, {}), InvalidInput);
}

}  // namespace
}  // namespace kinetix::model
