#include <gtest/gtest.h>
#include <limits>

#include "model/base/invalid_input.hpp"
#include "model/closure/closure.hpp"
#include "model/closure/mobility.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/square/unit_laws.hpp"
#include "tests/support/random_designs.hpp"
#include "tests/support/sodalite_arms.hpp"

namespace kinetix::model {
namespace {

using testing::random_design;
using testing::structure_of;

TEST(NullSpace, CountsOneFreedomOfEveryFamilyAtFlatAndFolded) {
  std::mt19937 random(31);
  for (const Family family : {Family::F1, Family::F2, Family::F3})
    for (const auto& [columns, rows] : {std::pair{1, 1}, {3, 2}, {6, 6}, {20, 1}, {20, 20}}) {
      const auto design = random_design(family, columns, rows, random);
      const Structure s = structure_of(design);
      EXPECT_EQ(null_space(s, rest_state(s)).dofs(), 1) << to_string(family) << " seed 31";
      EXPECT_EQ(null_space(s, fold(design, s)).dofs(), 1) << to_string(family) << " seed 31";
    }
}

TEST(NullSpace, DenseAndInverseIterationAgree) {
  std::mt19937 random(32);
  const Structure sheets[] = {structure_of(random_design(Family::F3, 4, 3, random)),
                              make_structure({{0, 0}, {1, 1}, {2, 2}}, {}),
                              make_structure(rectangle(5, 4), {})};
  for (const Structure& s : sheets) {
    const NullSpace dense = null_space(s, rest_state(s), NullSpaceMethod::dense);
    const NullSpace sparse = null_space(s, rest_state(s), NullSpaceMethod::inverse_iteration);
    ASSERT_EQ(dense.dofs(), sparse.dofs());
    EXPECT_NEAR(dense.smallest_other, sparse.smallest_other, 1e-6);
    const Eigen::MatrixXd overlap = dense.basis.transpose() * sparse.basis;
    EXPECT_LE((overlap * overlap.transpose() - Eigen::MatrixXd::Identity(dense.dofs(), dense.dofs())).norm(),
              1e-12);
  }
}

TEST(NullSpace, GrowsItsBlockUntilEveryFreedomIsFound) {
  std::vector<Cell> chain;
  for (int k = 0; k < 20; ++k) chain.push_back({k, k});
  const Structure s = make_structure(chain, {});
  EXPECT_EQ(null_space(s, rest_state(s), NullSpaceMethod::inverse_iteration).dofs(), 20);
}

// Arms of 1e-6 of an edge: rotors that turn alone open their hinges by so little.
TEST(NullSpace, ToldFromDirectionsThatAreNearlyFree) {
  const SodaliteStructure block =
      testing::block_with_arms({1, 1, 1}, {1e-6, 2e-6, 5e-7, 1e-6, 3e-6, 1e-6}, {10, 0.4, 1});
  const State state = exact_motion(block).at(0.4);
  EXPECT_EQ(null_space(block, state, NullSpaceMethod::dense).dofs(), 1);
  EXPECT_EQ(null_space(block, state, NullSpaceMethod::inverse_iteration).dofs(), 1);
}

TEST(NullSpace, BasisIsOrthonormalHoldsTheFirstBodyAndClosesEveryHinge) {
  std::mt19937 random(33);
  const auto design = random_design(Family::F2, 12, 9, random);
  const Structure s = structure_of(design);
  const State state = fold(design, s);
  const NullSpace space = null_space(s, state);
  EXPECT_NEAR((space.basis.transpose() * space.basis)(0, 0), 1, 1e-14);
  EXPECT_EQ(space.basis.topRows(6).norm(), 0);
  EXPECT_LE((closure_jacobian(s, state) * space.basis).norm(), 1e-13) << "seed 33";
}

/// Without the help of a closed form.
Mobility driven(const Structure& s) { return mobility(s, {}); }

void expect_counts(const Mobility& m, Verdict verdict, int flat, int along) {
  EXPECT_EQ(m.verdict, verdict) << m.why;
  EXPECT_EQ(m.dofs_flat, flat) << m.why;
  EXPECT_EQ(m.dofs_along, along) << m.why;
}

Structure patterned(std::vector<Cell> cells, const CellTuple& even, const CellTuple& odd) {
  Structure s = make_structure(std::move(cells), {});
  apply_pattern(s, even, odd, SharedWalls::must_agree);
  return s;
}

/// Tilts that differ over the columns and over the rows.
void curve_twice(Structure& s) {
  const double column[] = {0.7, 0.2, 0.6}, row[] = {0.3, 0.8, 0.4};
  for (Hinge& h : s.hinges) {
    const auto [i, j] = h.wall.from;
    const bool along_x = h.wall.axis == Axis::x;
    const double tilt = along_x ? column[i % 3] : row[j % 3];
    h.parameters.beta = ((along_x ? j : i) & 1) ? -tilt : tilt;
  }
}

TEST(Mobility, PapersUnitsHaveOneFreedom) {
  const CellTuple units[] = {{},
                             {.P = {0.8, 0.2, 0.8, 0.2}},
                             {.P = {0.8, 0.8, 0.8, 0.8}},
                             {.A_out = {40 * radians_per_degree, -25 * radians_per_degree,
                                        40 * radians_per_degree, -25 * radians_per_degree}},
                             {.A_out = {40 * radians_per_degree, 25 * radians_per_degree,
                                        40 * radians_per_degree, 25 * radians_per_degree}}};
  for (const CellTuple& unit : units)
    expect_counts(driven(patterned({{0, 0}}, unit, unit)), Verdict::mobile, 1, 1);
}

TEST(Mobility, PapersGridsHaveOneFreedomThoughGrueblerCountsMinusSeven) {
  const Structure equation_9 =
      patterned(rectangle(3, 5), {.P = {0.2, 0.8, 0.2, 0.8}}, {.P = {0.8, 0.2, 0.8, 0.2}});
  const Structure equation_10 =
      patterned(rectangle(3, 5), {.P = {0.3, 0.3, 0.3, 0.3}}, {.P = {0.7, 0.7, 0.7, 0.7}});
  for (const Structure& grid : {equation_9, equation_10}) {
    const Mobility m = driven(grid);
    expect_counts(m, Verdict::mobile, 1, 1);
    EXPECT_EQ(m.gruebler_planar, -7);
    EXPECT_EQ(m.gruebler_spatial, 6 * (23 - 38) + 38);
    EXPECT_LE(m.misfit, 1e-12);
  }
}

TEST(Mobility, ExactFamiliesHaveOneFreedomWhenDriven) {
  std::mt19937 random(51);
  for (const Family family : {Family::F1, Family::F2, Family::F3})
    for (const auto& [columns, rows] : {std::pair{1, 1}, {2, 2}, {4, 3}, {10, 1}, {7, 7}}) {
      SCOPED_TRACE(to_string(family) + " seed 51");
      const Structure s = structure_of(random_design(family, columns, rows, random));
      expect_counts(driven(s), Verdict::mobile, 1, 1);
    }
}

TEST(Mobility, ExactFamiliesHaveOneFreedomInClosedForm) {
  std::mt19937 random(52);
  for (const Family family : {Family::F1, Family::F2, Family::F3}) {
    const Structure s = structure_of(random_design(family, 15, 12, random));
    const Mobility m = mobility(s, exact_motion(s));
    expect_counts(m, Verdict::mobile, 1, 1);
    EXPECT_NE(m.why.find(to_string(family)), std::string::npos) << m.why;
  }
}

TEST(Mobility, DoublyCurvedPatchFoolsTheRankAtFlatAndNotTheMotion) {
  for (const int size : {2, 3, 5}) {
    Structure s = make_structure(rectangle(size, size), {});
    curve_twice(s);
    const Mobility m = mobility(s, exact_motion(s));
    expect_counts(m, Verdict::not_mobile, 1, 0);
    EXPECT_GT(m.misfit, 1e-4);
    EXPECT_FALSE(m.gruebler_planar.has_value());
  }
}

TEST(Mobility, RandomHingesHaveNoFreedom) {
  std::mt19937 random(53);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const auto& [columns, rows] : {std::pair{1, 1}, {2, 1}, {3, 3}}) {
    Structure s = make_structure(rectangle(columns, rows), {});
    for (Hinge& h : s.hinges)
      h.parameters = {0.5 + 0.4 * unit(random), pi / 2 + 0.5 * unit(random), 0.5 * unit(random)};
    expect_counts(mobility(s, exact_motion(s)), Verdict::not_mobile, 0, 0);
  }
}

TEST(Mobility, TwistUnitIsRigidAtFlat) {
  const CellTuple twist{.A_in = {pi / 2, 80 * radians_per_degree, pi / 2, 80 * radians_per_degree}};
  const Structure unit = patterned({{0, 0}}, twist, twist);
  expect_counts(mobility(unit, exact_motion(unit)), Verdict::not_mobile, 0, 0);
}

TEST(Mobility, PlanarStripWithArbitraryFractionsMovesOutsideTheFamilies) {
  std::mt19937 random(54);
  std::uniform_real_distribution<double> fraction(0.2, 0.8);
  const auto shuffled = [&](Structure s) {
    for (Hinge& h : s.hinges) h.parameters.t = fraction(random);
    return s;
  };
  const Structure strip = shuffled(make_structure(rectangle(6, 1), {}));
  EXPECT_EQ(classify(strip).family, Family::none);
  const Mobility m = mobility(strip, exact_motion(strip));
  expect_counts(m, Verdict::mobile, 1, 1);
  EXPECT_EQ(m.gruebler_planar, 1);
  const Structure patch = shuffled(make_structure(rectangle(2, 2), {}));
  const Mobility sheet = mobility(patch, exact_motion(patch));
  expect_counts(sheet, Verdict::not_mobile, 0, 0);
  EXPECT_EQ(sheet.gruebler_planar, 0);
}

/// kinematics.md, F4: a spine one cell wide along y, with bending rows, that carries ribs with tilts of their
/// own.
Structure fishbone(std::mt19937& random) {
  std::vector<Cell> cells = {{2, 1}, {2, 3}};
  for (const int row : {0, 2, 4})
    for (int i = 0; i < 5; ++i) cells.push_back({i, row});
  Structure s = make_structure(cells, {});
  std::uniform_real_distribution<double> tilt(-0.9, 0.9);
  const auto tilt_pair = [&](Wall a, Wall b) {
    const double beta = tilt(random);
    s.hinges[*s.hinge_at(a)].parameters.beta = beta;
    s.hinges[*s.hinge_at(b)].parameters.beta = -beta;
  };
  for (const int row : {0, 2, 4})
    for (const int i : {0, 1, 3, 4}) tilt_pair({{i, row}, Axis::x}, {{i, row + 1}, Axis::x});
  for (const int row : {1, 3}) tilt_pair({{2, row}, Axis::y}, {{3, row}, Axis::y});
  return s;
}

TEST(Mobility, FishboneNetHasOneFreedom) {
  std::mt19937 random(55);
  const Structure s = fishbone(random);
  EXPECT_EQ(classify(s).family, Family::F4) << "seed 55";
  expect_counts(mobility(s, exact_motion(s)), Verdict::mobile, 1, 1);
}

TEST(Mobility, PanelsJoinedAtOneVertexMoveByThemselves) {
  expect_counts(driven(make_structure({{0, 0}, {1, 1}}, {})), Verdict::mobile, 2, 2);
  expect_counts(driven(make_structure({{0, 0}, {1, 1}, {2, 2}, {3, 1}}, {})), Verdict::mobile, 4, 4);
}

TEST(Mobility, RingOfCellsJoinedAtVerticesMovesAsOne) {
  expect_counts(driven(make_structure({{0, 1}, {1, 0}, {1, 2}, {2, 1}}, {})), Verdict::mobile, 1, 1);
}

TEST(Mobility, TwoDoublyCurvedPatchesJoinedAtAVertexStayUndecided) {
  std::vector<Cell> cells = rectangle(2, 2);
  for (const Cell& c : rectangle(2, 2)) cells.push_back({c.i + 2, c.j + 2});
  Structure s = make_structure(cells, {});
  curve_twice(s);
  expect_counts(mobility(s, exact_motion(s), {.combinations = 1}), Verdict::undecided, 2, 0);
}

TEST(Mobility, IsTheSameOnEveryCall) {
  const Structure s = make_structure({{0, 0}, {1, 1}}, {});
  EXPECT_EQ(driven(s).misfit, driven(s).misfit);
}

TEST(Mobility, RefusesOptionsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Structure s = make_structure({{0, 0}}, {});
  for (const double turn : {0.0, 1.1, nan})
    EXPECT_THROW(mobility(s, exact_motion(s), {.turn = turn}), InvalidInput);
  EXPECT_THROW(mobility(s, exact_motion(s), {.steps = 1}), InvalidInput);
  EXPECT_THROW(mobility(s, exact_motion(s), {.closed = nan}), InvalidInput);
  EXPECT_THROW(mobility(s, exact_motion(s), {.combinations = -1}), InvalidInput);
}

}  // namespace
}  // namespace kinetix::model
