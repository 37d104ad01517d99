#include "model/opening/cell_opening.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

#include "model/closure/closure.hpp"
#include "model/lattice/square/family/classification.hpp"
#include "tests/support/derivatives.hpp"

namespace kinetix::model {
namespace {

using Eigen::VectorXd;

struct Panel {
  Structure structure;
  State state;
  Opening at(std::size_t cell = 0) const {
    const Linkage linkage = structure;
    return opening(linkage, state, linkage.cells[cell]);
  }
};

Panel basic_panel(double theta) {
  Panel panel{make_structure(rectangle(2, 1), {}), {}};
  panel.state = fold(classify(panel.structure), panel.structure, theta);
  return panel;
}

double wall_over_edge(const Panel& panel) {
  return panel.structure.size.thickness_mm / panel.structure.size.edge_mm;
}

TEST(CellOpening, AFlatCellIsASquareLessItsWalls) {
  const Panel panel = basic_panel(0);
  EXPECT_NEAR(aperture(panel.at()), 1 - wall_over_edge(panel), 1e-6);
  EXPECT_NEAR(area(panel.at()), 1, 1e-14);
}

// Two wall tips come in as far as the other two go out.
TEST(CellOpening, ABasicCellKeepsTheAreaOfItsSquareOfVertices) {
  for (const double theta : {0.1, 0.3, 0.5, 0.7})
    for (const std::size_t cell : {0, 1})
      EXPECT_NEAR(area(basic_panel(theta).at(cell)), std::cos(theta) * std::cos(theta), 1e-14) << theta;
}

// At 45 deg two wall tips meet in the middle, and the pockets beside them are squares of half the edge.
TEST(CellOpening, AtClosureTheWidestCircleFillsAPocket) {
  const Panel panel = basic_panel(pi / 4);
  EXPECT_NEAR(aperture(panel.at()), 0.5 - wall_over_edge(panel), 1e-6);
}

TEST(CellOpening, TheWidestCircleIsWiderThanAnyOnAGrid) {
  for (const double theta : {0.2, 0.45, 0.6}) {
    const Opening o = basic_panel(theta).at();
    double best = 0;
    for (double x = -1; x < 2; x += 0.01)
      for (double y = -1; y < 2; y += 0.01)
        if (o.contains({x, y})) best = std::max(best, 2 * (o.clearance({x, y}) - o.half_thickness));
    EXPECT_LE(best, aperture(o) + 1e-6);
    EXPECT_GE(best, aperture(o) - 0.02);
  }
}

// Between parallel walls all circles of a row are equally wide, so none of them is searched for separately.
TEST(CellOpening, OfASlotIsItsWidthTakenAtOnce) {
  Opening slot;
  const std::vector<Eigen::Vector2d> corners = {{0, 0},   {50, 0}, {100, 0}, {100, 0.5},
                                                {100, 1}, {50, 1}, {0, 1},   {0, 0.5}};
  for (std::size_t k = 0; k < 4; ++k) {
    slot.sides.push_back({corners[2 * k], corners[2 * k + 1]});
    slot.sides.push_back({corners[(2 * k + 2) % 8], corners[2 * k + 1]});
  }
  EXPECT_NEAR(aperture(slot, 1e-9), 1, 1e-9) << "by squares alone it would not end";
}

TEST(CellOpening, NoCircleFitsBetweenWallsThatAreTooThick) {
  Opening o = basic_panel(pi / 4).at();
  o.half_thickness = 0.3;
  EXPECT_EQ(aperture(o), 0);
}

TEST(CellOpening, ABrokenStateHasNoAperture) {
  Panel panel = basic_panel(0.3);
  panel.state[0].p.x() = NAN;
  EXPECT_TRUE(std::isnan(aperture(panel.at())));
}

/// Returns a flat panel whose bodies are moved apart. All hinges are stretched by `gap` cell edges, and their wall tips
/// are on one line.
Panel pulled_apart(double gap) {
  Panel panel = basic_panel(0);
  for (std::size_t b = 0; b < panel.state.size(); ++b) {
    const Vertex v = panel.structure.bodies[b];
    panel.state[b].p += gap * panel.structure.size.edge_mm * Eigen::Vector3d(v.i, v.j, 0);
  }
  return panel;
}

TEST(CellOpening, AStretchedHingeClosesItsGapByAStraightLine) {
  for (const double gap : {1e-9, 0.01, 0.1, 0.4, 0.9}) {
    const Opening o = pulled_apart(gap).at();
    EXPECT_NEAR(aperture(o), 1 + gap - 2 * o.half_thickness, 1e-6) << gap;
    EXPECT_NEAR(area(o), (1 + gap) * (1 + gap), 1e-12) << gap;
    EXPECT_NEAR(soft_aperture(o, 1e4).value, 1 + gap - 2 * o.half_thickness, 2 * std::log(12) / 1e4) << gap;
  }
}

// The wall tips of a wall stand apart along it: an outside reader has the largest circle of the polygon with
// both.
TEST(CellOpening, TheApertureIsThatOfThePolygonWithBothEndsOfEveryHinge) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> off(-0.2, 0.2);
  for (int k = 0; k < 10; ++k) {
    Panel panel = basic_panel(0.4);
    for (Pose& pose : panel.state) pose.p += 10 * Eigen::Vector3d(off(random), off(random), 0);
    const Opening o = panel.at();
    const std::vector<Eigen::Vector2d> corners = o.outline();
    for (double x = -0.5; x < 1.5; x += 0.1)
      for (double y = -0.5; y < 1.5; y += 0.1) {
        double least = 9;
        for (std::size_t m = 0; m < 12; ++m)
          for (double at = 0; at <= 1; at += 2e-3)
            least = std::min(
                least, ((1 - at) * corners[m] + at * corners[(m + 1) % 12] - Eigen::Vector2d(x, y)).norm());
        EXPECT_NEAR(o.clearance({x, y}), least, 1e-3) << "seed 8";
        if (o.contains({x, y})) {
          EXPECT_GE(aperture(o), 2 * (o.clearance({x, y}) - o.half_thickness) - 1e-6) << "seed 8";
        }
      }
  }
}

/// Cells whose hinges and bodies are up to `most` off a folded basic one, edges and rad.
std::vector<Panel> irregular_panels(double most = 0.08) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> off(-most, most);
  std::vector<Panel> panels;
  for (int k = 0; k < 20; ++k) {
    Panel panel = basic_panel(0.02 * k + 0.1);
    for (Hinge& hinge : panel.structure.hinges) hinge.parameters.t += off(random);
    VectorXd twists = VectorXd::Zero(6 * panel.state.size());
    for (std::size_t b = 0; b < panel.state.size(); ++b)
      for (const int c : {2, 3, 4}) twists[6 * b + c] = off(random);
    panel.state = retract_straight(panel.structure, panel.state, twists);
    panels.push_back(panel);
  }
  return panels;
}

/// A reading of the first cell as a function of the turns and shifts of its bodies and the t of its hinges.
template <class Read>
void expect_derivatives(const Panel& panel, const Read& read, double step = 1e-4) {
  const CellHinges& cell = panel.structure.cell_members[0];
  const auto value = [&](const VectorXd& q) -> VectorXd {
    Panel changed = panel;
    VectorXd twists = VectorXd::Zero(6 * panel.state.size());
    for (int m = 0; m < 4; ++m) {
      twists.segment<3>(6 * cell.bodies[m] + 2) = q.segment<3>(3 * m);
      changed.structure.hinges[cell.hinges[m]].parameters.t += q[12 + m];
    }
    changed.state = retract_straight(panel.structure, panel.state, twists);
    return VectorXd::Constant(1, read(changed.at()).value);
  };
  const CellReading reading = read(panel.at());
  Eigen::RowVectorXd analytic(16);
  for (int m = 0; m < 4; ++m) {
    analytic.segment<3>(3 * m) = reading.bodies.col(m);
    analytic[12 + m] = reading.t[m];
  }
  testing::expect_jacobian(value, VectorXd::Zero(16), analytic, 1e-6, step);
}

TEST(SoftAperture, DerivativesMatchCentralDifferences) {
  for (const double most : {0.003, 0.01, 0.03, 0.08, 0.15})
    for (const Panel& panel : irregular_panels(most))
      expect_derivatives(
          panel, [](const Opening& o) { return soft_aperture(o); }, 1e-6);
}

/// The widest circle lies at the gaps, or, where they are about as long as the soft minimum is soft, at gaps
/// that begin to weigh. The steps are small against the gaps.
TEST(SoftAperture, DerivativesMatchCentralDifferencesAtGaps) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> off(-1, 1);
  for (const double gap : {0.003, 0.0125, 0.03, 0.2, 0.5})
    for (int k = 0; k < 5; ++k) {
      Panel panel = pulled_apart(gap);
      VectorXd twists = VectorXd::Zero(6 * panel.state.size());
      for (std::size_t b = 0; b < panel.state.size(); ++b)
        for (const int c : {2, 3, 4}) twists[6 * b + c] = 0.1 * gap * off(random);
      panel.state = retract_straight(panel.structure, panel.state, twists);
      expect_derivatives(
          panel, [](const Opening& o) { return soft_aperture(o); }, 1e-6);
    }
}

/// A single cell of any fractions moves without a gap; it has no symmetry, so that one pocket is the widest.
TEST(SoftAperture, DerivativesMatchCentralDifferencesWhereAllHingesAreClosed) {
  for (const double theta : {0.1, 0.3, 0.5}) {
    Panel panel{make_structure({{0, 0}}, {}), {}};
    const double fractions[] = {0.42, 0.55, 0.47, 0.6};
    for (int k = 0; k < 4; ++k) panel.structure.hinges[k].parameters.t = fractions[k];
    panel.state = rest_state(panel.structure);
    for (double turn = 0.02; turn < 2 * theta + 0.01; turn += 0.02)
      panel.state = solve_closure(panel.structure, panel.state, {HingeTurn{0, turn}}).state;
    ASSERT_LE(hinge_gaps(panel.structure, panel.state).max, 1e-10);
    expect_derivatives(
        panel, [](const Opening& o) { return soft_aperture(o); }, 1e-5);
  }
}

TEST(AreaReading, DerivativesMatchCentralDifferences) {
  for (const Panel& panel : irregular_panels()) expect_derivatives(panel, area_reading);
}

TEST(SoftAperture, IsBelowTheApertureByNoMoreThanItsSharpnessSays) {
  for (const double most : {0.003, 0.01, 0.03, 0.08, 0.15})
    for (const Panel& panel : irregular_panels(most))
      for (const double sharpness : {80.0, 160.0}) {
        const double less = aperture(panel.at()) - soft_aperture(panel.at(), sharpness).value;
        EXPECT_GE(less, -1e-6);
        EXPECT_LE(less, 2 * std::log(12) / sharpness);
      }
}

}  // namespace
}  // namespace kinetix::model
