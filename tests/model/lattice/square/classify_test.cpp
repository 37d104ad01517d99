#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <complex>
#include <limits>
#include <random>

#include "model/lattice/square/family/classification.hpp"
#include "model/lattice/square/unit_laws.hpp"
#include "tests/support/random_designs.hpp"

namespace kinetix::model {
namespace {

using testing::random_design;
using testing::structure_of;

/// Mirror image with x and y exchanged, written from the definition of the hinge axis.
Structure exchanged(const Structure& s) {
  std::vector<Cell> cells;
  for (const Cell& c : s.cells) cells.push_back({c.j, c.i});
  Structure out = make_structure(cells, s.size);
  for (Hinge& h : out.hinges) {
    const Vertex from{h.wall.from.j, h.wall.from.i};
    h.parameters = s.hinges[*s.hinge_at({from, h.wall.axis == Axis::x ? Axis::y : Axis::x})].parameters;
    h.parameters.beta *= -1;
  }
  return out;
}

void expect_exact(const Structure& s, Family family, bool transposed) {
  const Classification c = classify(s);
  ASSERT_EQ(c.family, family) << c.why;
  EXPECT_EQ(c.transposed, transposed);
  EXPECT_EQ(c.breaking_hinge, -1);
  for (const double theta : {-0.6, 0.0, 0.4}) {
    const HingeGaps gaps = hinge_gaps(s, fold(c, s, theta));
    EXPECT_LE(gaps.max, 1e-12) << to_string(family) << " theta " << theta;
    EXPECT_LE(gaps.axis_max, 1e-12);
  }
}

TEST(Classify, FindsEveryFamilyAlongBothAxes) {
  std::mt19937 random(81);
  for (const auto& [columns, rows] : {std::pair{3, 3}, {7, 4}, {4, 9}})
    for (const Family family : {Family::F1, Family::F2, Family::F3}) {
      auto design = random_design(family, columns, rows, random);
      if (family == Family::F2) design.beta[0] = 0.3, design.t[0] = 0.5;
      const Structure s = structure_of(design);
      SCOPED_TRACE("seed 81");
      expect_exact(s, family, false);
      expect_exact(exchanged(s), family, family != Family::F1);
    }
}

TEST(Classify, GivesBackTheDesignOfASheet) {
  std::mt19937 random(82);
  for (const Family family : {Family::F1, Family::F2, Family::F3}) {
    const auto design = random_design(family, 5, 4, random);
    const auto found = classify(structure_of(design)).design;
    EXPECT_EQ(found.beta, design.beta);
    for (int c = 0; c < 5; ++c) EXPECT_NEAR(found.t[c], design.t[c], 1e-15);
    for (int r = 0; r < 4; ++r) EXPECT_NEAR(found.s[r], design.s[r], 1e-15);
    EXPECT_EQ(found.gamma, design.gamma);
    EXPECT_EQ(found.theta, 0);
  }
}

/// kinematics.md, F1: vertex (i, j) is the sum of ex over columns and of ey over rows.
TEST(Classify, PlanarSheetFoldsToItsClosedForm) {
  std::mt19937 random(83);
  const auto design = random_design(Family::F1, 6, 5, random);
  const Structure s = structure_of(design);
  const double theta = 0.5, L = s.size.edge_mm;
  const State state = fold(classify(s), s, theta);
  const auto edge = [&](double t) {
    return L * std::complex(std::cos(theta), (2 * t - 1) * std::sin(theta));
  };
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    std::complex<double> p = 0;
    for (int c = 0; c < s.bodies[b].i; ++c) p += edge(design.t[c]);
    for (int r = 0; r < s.bodies[b].j; ++r) p += std::complex(0.0, 1.0) * edge(design.s[r]);
    EXPECT_NEAR(state[b].p.x(), p.real(), 1e-12) << "seed 83";
    EXPECT_NEAR(state[b].p.y(), p.imag(), 1e-12) << "seed 83";
    const double turn = std::atan2(state[b].R(1, 0), state[b].R(0, 0));
    EXPECT_NEAR(turn, s.bodies[b].is_in_sublattice_a() ? theta : -theta, 1e-14);
  }
}

TEST(Classify, ThetaTurnsTheFirstBodyAboutItsOwnRowAxis) {
  std::mt19937 random(84);
  for (const Family family : {Family::F2, Family::F3})
    for (const bool transposed : {false, true}) {
      const Structure sheet = structure_of(random_design(family, 4, 3, random));
      const Structure s = transposed ? exchanged(sheet) : sheet;
      const Hinge& row = s.hinges[*s.hinge_at({{0, 0}, transposed ? Axis::x : Axis::y})];
      const Eigen::AngleAxisd turn(0.3, hinge_axis(row.wall.axis, row.parameters));
      const State state = fold(classify(s), s, 0.3);
      EXPECT_LE((state[0].R - turn.toRotationMatrix()).norm(), 1e-14) << "seed 84 " << transposed;
    }
}

TEST(Classify, PapersGridsArePlanar) {
  for (const auto& [even, odd] :
       {std::pair{CellTuple{.P = {0.2, 0.8, 0.2, 0.8}}, CellTuple{.P = {0.8, 0.2, 0.8, 0.2}}},
        {CellTuple{.P = {0.3, 0.3, 0.3, 0.3}}, CellTuple{.P = {0.7, 0.7, 0.7, 0.7}}}}) {
    Structure s = make_structure(rectangle(3, 5), {});
    apply_pattern(s, even, odd, SharedWalls::must_agree);
    expect_exact(s, Family::F1, false);
  }
}

TEST(Classify, SingleCellBelongsToTheFirstFamilyItFits) {
  const auto cell = [](double bottom, double right, double top, double left) {
    Structure s = make_structure({{0, 0}}, {});
    const double tilts[] = {bottom, right, top, left};
    for (int k = 0; k < 4; ++k) s.hinges[k].parameters.beta = tilts[k];
    return s;
  };
  expect_exact(cell(0, 0, 0, 0), Family::F1, false);
  expect_exact(cell(0.4, 0, -0.4, 0), Family::F2, false);
  expect_exact(cell(0, 0.4, 0, -0.4), Family::F3, false);
  expect_exact(cell(0.4, -0.3, -0.4, 0.3), Family::F3, false);
  EXPECT_EQ(classify(cell(0.4, 0, 0.4, 0)).family, Family::none);
  EXPECT_EQ(classify(cell(0.4, 0.3, 0.4, 0.3)).family, Family::none);
}

TEST(Classify, CellSetsOfAnyShapeAreCutFromTheirSheet) {
  std::mt19937 random(85);
  const std::vector<Cell> shapes[] = {{{0, 0}, {1, 0}, {2, 0}, {0, 1}, {0, 2}},
                                      {{0, 0}, {1, 1}, {2, 2}},
                                      {{2, 3}, {3, 3}, {3, 4}},
                                      {{0, 0}, {0, 1}, {0, 2}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}}};
  for (const auto& cells : shapes)
    for (const Family family : {Family::F1, Family::F2, Family::F3}) {
      Structure s = make_structure(cells, {});
      auto design = random_design(family, 4, 5, random);
      for (double& beta : design.beta) beta += family == Family::F1 ? 0 : 0.01;
      if (family != Family::F1) design.t.assign(4, 0.5);
      apply(design, s);
      SCOPED_TRACE("seed 85");
      expect_exact(s, family, false);
      EXPECT_LE(aligned_distance(s, fold(classify(s), s, 0), rest_state(s)).max, 1e-13);
    }
}

/// Every hinge of a sheet is put out of order in turn: it alone is named.
TEST(Classify, NamesTheHingeThatBreaksTheRule) {
  std::mt19937 random(86);
  for (const Family family : {Family::F1, Family::F2, Family::F3})
    for (const bool transposed : {false, true}) {
      const Structure made = structure_of(random_design(family, 4, 4, random));
      const Structure sheet = transposed ? exchanged(made) : made;
      for (std::size_t k = 0; k < sheet.hinges.size(); ++k) {
        Structure s = sheet;
        s.hinges[k].parameters.alpha += 0.1;
        const Classification c = classify(s);
        EXPECT_EQ(c.family, Family::none);
        EXPECT_EQ(c.breaking_hinge, static_cast<int>(k)) << "seed 86";
        EXPECT_NE(c.why.find("alpha = 90 deg"), std::string::npos) << c.why;
        EXPECT_EQ(c.design.columns(), 0);
        s = sheet;
        s.hinges[k].parameters.t += 0.01;
        EXPECT_EQ(classify(s).breaking_hinge, static_cast<int>(k)) << "seed 86 " << classify(s).why;
      }
    }
}

TEST(Classify, NamesTheFirstOfSeveralHingesInTheStructuresOwnOrder) {
  std::mt19937 random(87);
  const Structure made = structure_of(random_design(Family::F2, 5, 5, random));
  for (Structure s : {made, exchanged(made)}) {
    for (const int k : {41, 17, 30}) s.hinges[k].parameters.alpha = 1;
    EXPECT_EQ(classify(s).breaking_hinge, 17) << "seed 87";
  }
}

TEST(Classify, WhyNamesTheWall) {
  Structure s = make_structure(rectangle(3, 3), {});
  s.hinges[*s.hinge_at({{1, 2}, Axis::y})].parameters.alpha = 1;
  const std::string why = classify(s).why;
  EXPECT_NE(why.find("wall [[1, 2], [1, 3]]"), std::string::npos) << why;
}

TEST(Classify, ToleranceDecidesNearMisses) {
  Structure s = make_structure(rectangle(3, 3), {});
  s.hinges[5].parameters.t += 1e-4;
  s.hinges[7].parameters.beta += 1e-4;
  EXPECT_EQ(classify(s).family, Family::none);
  EXPECT_EQ(classify(s, 2e-4).family, Family::F1);
  EXPECT_EQ(classify(s, 0.5e-4).family, Family::none);
}

TEST(Classify, DoublyCurvedPatchIsOfNoFamily) {
  Structure s = make_structure(rectangle(3, 3), {});
  for (Hinge& h : s.hinges) {
    const auto [i, j] = h.wall.from;
    const bool along_x = h.wall.axis == Axis::x;
    h.parameters.beta = ((along_x ? j : i) & 1 ? -0.1 : 0.1) * (1 + (along_x ? i : j));
  }
  EXPECT_EQ(classify(s).family, Family::none);
}

TEST(Classify, NumbersThatAreNotFiniteBreakEveryRule) {
  Structure s = make_structure(rectangle(2, 2), {});
  s.hinges[3].parameters.t = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(classify(s).breaking_hinge, 3);
  for (Hinge& h : s.hinges) h.parameters.beta = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(classify(s).family, Family::none);
}

/// A sheet whose hinges sit where a random redrawing of its vertices has them.
Structure redrawn_sheet(std::vector<Cell> cells, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> by(-0.2, 0.2);
  Structure s = make_structure(std::move(cells), {});
  ParallelDrawing y(s.bodies.size());
  for (Eigen::Vector2d& p : y) p = {by(random), by(random)};
  place_hinges(y, s);
  return s;
}

std::vector<Cell> ring() {
  std::vector<Cell> cells;
  for (const Cell& c : rectangle(4, 4))
    if (c.i == 0 || c.j == 0 || c.i == 3 || c.j == 3) cells.push_back(c);
  return cells;
}

TEST(Classify, UprightHingesAnywhereThatCloseEveryFaceArePlanar) {
  for (const auto& cells : {rectangle(5, 4), ring()}) {
    const Structure s = redrawn_sheet(cells, 3);
    const Classification kind = classify(s);
    ASSERT_EQ(kind.family, Family::planar) << kind.why;
    for (const double theta : {-0.6, 0.2, 1.1})
      EXPECT_LE(hinge_gaps(s, fold(kind, s, theta)).max, 1e-14) << theta;
  }
}

TEST(Classify, NamesTheCellOrTheHoleThatDoesNotClose) {
  Structure s = redrawn_sheet(rectangle(5, 4), 3);
  s.hinges[*s.hinge_at({{0, 0}, Axis::x})].parameters.offset += 0.01;
  EXPECT_THAT(classify(s).why,
              ::testing::HasSubstr("the cell from [0, 0] to [1, 1] does not close: it is off by 0.02"));
  EXPECT_EQ(classify(s).family, Family::none);

  const Structure open = make_structure(ring(), {});
  const PlanarStructure planar = planar_structure(open);
  ASSERT_EQ(planar.faces.size(), open.cells.size() + 1);
  EXPECT_EQ(planar.faces.back().edges.size(), 8u);
}

TEST(Classify, OffsetsNeedUprightHinges) {
  Structure s = make_structure(rectangle(4, 1), {});
  for (Hinge& h : s.hinges)
    if (h.wall.axis == Axis::x) h.parameters.beta = h.wall.from.j == 0 ? 0.3 : -0.3;
  ASSERT_EQ(classify(s).family, Family::F2);
  s.hinges[0].parameters.offset = 0.05;
  EXPECT_THAT(classify(s).why, ::testing::HasSubstr("(offset) need upright hinges"));
}

TEST(Classify, FamiliesHaveTheirNames) {
  EXPECT_EQ(to_string(Family::planar), "planar");
  EXPECT_EQ(to_string(Family::F1), "F1");
  EXPECT_EQ(to_string(Family::F2), "F2");
  EXPECT_EQ(to_string(Family::F3), "F3");
  EXPECT_EQ(to_string(Family::none), "none");
  EXPECT_NE(classify(make_structure({{0, 0}}, {})).why.find("F1"), std::string::npos);
}

}  // namespace
}  // namespace kinetix::model
