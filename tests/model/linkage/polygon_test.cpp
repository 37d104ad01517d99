#include "tests/support/polygons.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "model/closure/closure.hpp"
#include "model/closure/mobility.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/opening/cell_opening.hpp"

namespace kinetix::model {
namespace {

using testing::hexagon;
using testing::Polygon;
using testing::rhombus;

// Hinges in the middle of walls and off it, angles (rad) under and over a right one.
const Polygon polygons[] = {hexagon(), hexagon(0.3, -0.2, 0.1), rhombus(1.2), rhombus(2.0, 0.2, -0.3)};

TEST(PolygonLinkage, ItsClosedFormClosesEveryHinge) {
  for (const Polygon& polygon : polygons) {
    const Linkage linkage = linkage_of(polygon);
    for (const double theta : {-0.6, 0.1, 0.4}) {
      const State state = folded(polygon, linkage.size.edge_mm, theta);
      EXPECT_LE(closure_residual(linkage, state).cwiseAbs().maxCoeff(), 1e-15);
      EXPECT_LE(hinge_gaps(linkage, state).max, 1e-15);
    }
  }
}

// A ring of n bodies and n hinges in the plane.
TEST(PolygonLinkage, MovesWithOneDegreeOfFreedomForEachWallBeyondThree) {
  for (const Polygon& polygon : polygons) {
    const Linkage linkage = linkage_of(polygon);
    const Mobility m = mobility(linkage, exact_motion(polygon, linkage.size.edge_mm));
    EXPECT_EQ(m.verdict, Verdict::mobile) << m.why;
    EXPECT_EQ(m.gruebler_planar, polygon.walls() - 3);
    EXPECT_EQ(m.dofs_along, polygon.walls() - 3);
  }
}

// Wall tips come in and go out by turns.
TEST(PolygonLinkage, AHexagonOfHalvedWallsKeepsTheAreaOfItsCorners) {
  const Linkage linkage = linkage_of(hexagon());
  for (const double theta : {0.0, 0.2, 0.5}) {
    const State state = folded(hexagon(), linkage.size.edge_mm, theta);
    const double expected = 1.5 * std::sqrt(3.0) * std::cos(theta) * std::cos(theta);
    EXPECT_NEAR(area(opening(linkage, state, linkage.cells[0])), expected, 1e-14);
  }
}

// The tips of opposite halved walls of a square meet at 45 deg; nothing of it asks for a square lattice.
TEST(PolygonLinkage, WallsOfARightAngledRhombusMeetWhereThoseOfABasicCellDo) {
  const Polygon square = rhombus(pi / 2);
  const Linkage linkage = linkage_of(square);
  const ContactRange range = theta_range(linkage, exact_motion(square, linkage.size.edge_mm));
  EXPECT_TRUE(range.positive.touches);
  EXPECT_NEAR(range.positive.theta, closing_theta(linkage.size), 1e-8);
}

// Nothing strains but the pins, by k_turn / (k_point edge^2) = 1e-9 of a cell edge: four hinges turn by 2
// theta each, and the drive lifts them all. Its load is the stiffness that holds it, 100 k_point edge^2,
// times the error that rounding leaves.
TEST(PolygonLinkage, ARhombusOfElasticHingesFollowsItsClosedForm) {
  const double k_turn = 0.1, theta = 0.4, turn = 2 * theta;
  for (const Polygon& polygon : {rhombus(1.2), rhombus(2.0, 0.2, -0.3)}) {
    const DrivenLinkage scene = testing::driven(polygon, theta);
    EquilibriumPathOptions options;
    options.contact = false;
    const EquilibriumPath path = trace_equilibrium(scene, {.k_point = 1e6, .k_turn = k_turn}, options);
    ASSERT_EQ(path.stop, EquilibriumPath::Stop::reached) << path.why;
    EXPECT_LE(aligned_distance(scene.linkage, path.state, scene.exact.at(theta)).rms, 1e-8);
    EXPECT_NEAR(path.steps.back().energy, 4 * 0.5 * k_turn * turn * turn, 1e-8);
    EXPECT_NEAR(std::abs(path.steps.back().load), 4 * k_turn * turn, 1e-5);
  }
}

}  // namespace
}  // namespace kinetix::model
