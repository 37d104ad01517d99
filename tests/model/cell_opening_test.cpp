#include "model/cell_opening.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "model/classify.hpp"
#include "model/closure.hpp"
#include "model/soft_aperture.hpp"
#include "tests/support/derivatives.hpp"

namespace kinetix {
namespace {

using Eigen::VectorXd;

struct Panel {
  Structure structure;
  State state;
  Opening at(std::size_t cell = 0) const { return opening(structure, state, structure.cell_members[cell]); }
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

// Two knees come in as far as the other two go out.
TEST(CellOpening, ABasicCellKeepsTheAreaOfItsSquareOfVertices) {
  for (const double theta : {0.1, 0.3, 0.5, 0.7})
    for (const std::size_t cell : {0, 1})
      EXPECT_NEAR(area(basic_panel(theta).at(cell)), std::cos(theta) * std::cos(theta), 1e-14) << theta;
}

// At 45 deg two knees meet in the middle, and the pockets beside them are squares of half the edge.
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

/// Cells whose hinges and bodies are a little off a folded basic one.
std::vector<Panel> irregular_panels() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> off(-0.08, 0.08);
  std::vector<Panel> panels;
  for (int k = 0; k < 20; ++k) {
    Panel panel = basic_panel(0.02 * k + 0.1);
    for (Hinge& hinge : panel.structure.hinges) hinge.parameters.t += off(random);
    VectorXd twists = VectorXd::Zero(6 * panel.state.size());
    for (std::size_t b = 0; b < panel.state.size(); ++b)
      for (const int c : {2, 3, 4}) twists[6 * b + c] = off(random);
    panel.state = moved(panel.structure, panel.state, twists);
    panels.push_back(panel);
  }
  return panels;
}

/// A reading of the first cell as a function of the turns and shifts of its bodies and the t of its hinges.
template <class Read>
void expect_derivatives(const Panel& panel, const Read& read) {
  const CellHinges& cell = panel.structure.cell_members[0];
  const auto value = [&](const VectorXd& q) -> VectorXd {
    Panel changed = panel;
    VectorXd twists = VectorXd::Zero(6 * panel.state.size());
    for (int m = 0; m < 4; ++m) {
      twists.segment<3>(6 * cell.bodies[m] + 2) = q.segment<3>(3 * m);
      changed.structure.hinges[cell.hinges[m]].parameters.t += q[12 + m];
    }
    changed.state = moved(panel.structure, panel.state, twists);
    return VectorXd::Constant(1, read(changed.at()).value);
  };
  const CellReading reading = read(panel.at());
  Eigen::RowVectorXd analytic(16);
  for (int m = 0; m < 4; ++m) {
    analytic.segment<3>(3 * m) = reading.bodies.col(m);
    analytic[12 + m] = reading.t[m];
  }
  testing::expect_jacobian(value, VectorXd::Zero(16), analytic, 1e-6, 1e-4);
}

TEST(SoftAperture, DerivativesMatchCentralDifferences) {
  for (const Panel& panel : irregular_panels())
    expect_derivatives(panel, [](const Opening& o) { return soft_aperture(o); });
}

TEST(AreaReading, DerivativesMatchCentralDifferences) {
  for (const Panel& panel : irregular_panels()) expect_derivatives(panel, area_reading);
}

TEST(SoftAperture, IsBelowTheApertureByNoMoreThanItsSharpnessSays) {
  for (const Panel& panel : irregular_panels())
    for (const double sharpness : {80.0, 160.0}) {
      const double less = aperture(panel.at()) - soft_aperture(panel.at(), sharpness).value;
      EXPECT_GE(less, -1e-6);
      EXPECT_LE(less, 2 * std::log(8) / sharpness);
    }
}

}  // namespace
}  // namespace kinetix
