#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "model/closure/closure.hpp"
#include "model/closure/mobility.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/elastic/tangent_stiffness.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;
using namespace testing;
using Kind = PathEvent::Kind;
using Stop = EquilibriumPath::Stop;

// For comparisons with closed forms, whose walls pass through each other.
const EquilibriumPathOptions no_contact = without_contact();

EquilibriumPath driven(const Structure& s, double theta, double k_turn = 0.1) {
  return trace_equilibrium(driven(s, drive_to(s, theta)), {.k_turn = k_turn}, no_contact);
}

double error(const Structure& s, double theta, double k_turn) {
  const EquilibriumPath path = driven(s, theta, k_turn);
  EXPECT_EQ(path.stop, Stop::reached) << path.why;
  return from_closed_form(s, path);
}

// ---- Figs. 9 and 10 ----

TEST(PaperGrids, At45DegreesTheyAreTheClosedFormButForTheStiffnessRatio) {
  for (const Structure& s : {crossable_grid(), uncrossable_grid()})
    for (const double theta : {22.5 * radians_per_degree, -22.5 * radians_per_degree}) {
      const double soft = error(s, theta, 0.1), stiff = error(s, theta, 1e-3);
      EXPECT_LE(soft, 1e-3);
      EXPECT_NEAR(soft / stiff, 100, 2);
      EXPECT_NEAR(driven(s, theta, 1e-3).steps.back().energy, planar_energy(s, 1e-3, theta), 1e-6);
    }
}

/// At 90 degrees the bars of all cells are on one line. The hinges resist a motion off it in the third order only, so
/// the distance grows with the cube root of the stiffness ratio.
TEST(PaperGrids, At90DegreesTheDistanceGoesWithTheCubeRootOfTheStiffnessRatio) {
  for (const Structure& s : {crossable_grid(), uncrossable_grid()})
    EXPECT_NEAR(error(s, 45 * radians_per_degree, 1e-2) / error(s, 45 * radians_per_degree, 1e-5), 10, 0.3);
}

TEST(PaperGrids, At135DegreesTheClosedFormIsAEquilibriumButForTheStiffnessRatio) {
  const auto distance = [](const Structure& s, double theta, double k_turn) {
    ElasticSystem system(s, {.k_turn = k_turn}, drive_on(s, drive_to(s, theta)), true, false);
    State state = fold(classify(s), s, theta);
    TangentStiffness tangent(system.dofs());
    const NewtonResult result = minimise(system, theta, {}, state, tangent);
    EXPECT_TRUE(result.converged && result.stable);
    return from_closed_form(s, state, theta);
  };
  for (const Structure& s : {crossable_grid(), uncrossable_grid()})
    for (const double theta : {67.5 * radians_per_degree, -67.5 * radians_per_degree}) {
      const double soft = distance(s, theta, 0.1);
      EXPECT_LE(soft, 3e-3);
      EXPECT_NEAR(soft / distance(s, theta, 1e-3), 100, 3);
    }
}

/// Fig. 10.D.
TEST(PaperGrids, UncrossableGridTouchesWhereTheClosedFormDoesAndLocks) {
  const Structure s = uncrossable_grid();
  const ContactRange exact = theta_range(s, exact_motion(s));
  for (const double sign : {1.0, -1.0}) {
    const double limit = std::abs(sign > 0 ? exact.positive.theta : exact.negative.theta);
    EquilibriumPathOptions fine;
    fine.longest_step = 0.01;
    const EquilibriumPath path =
        trace_equilibrium(driven(s, drive_to(s, sign * 46 * radians_per_degree)), {.k_turn = 1e-3}, fine);
    const PathEvent* contact = first_event(path, Kind::contact);
    const PathEvent* lock = first_event(path, Kind::lock);
    ASSERT_TRUE(contact && lock);
    EXPECT_NEAR(std::abs(contact->at.theta), limit, 5e-4);
    EXPECT_LE(std::abs(lock->at.theta), limit + 1 * radians_per_degree);
    EXPECT_GE(std::abs(path.steps.back().load),
              50 * std::abs(driven(s, sign * limit, 1e-3).steps.back().load));
    EXPECT_NE(lock->what.find("walls carry the drive"), std::string::npos);
  }
}

TEST(PaperGrids, CrossableGridPasses90DegreesWithoutContact) {
  const EquilibriumPath path =
      trace_equilibrium(driven(crossable_grid(), drive_to(crossable_grid(), 46 * radians_per_degree)), {});
  EXPECT_EQ(path.stop, Stop::reached);
  EXPECT_FALSE(first_event(path, Kind::contact));
}

// ---- Figs. 13 and 14 ----

/// The energy is E = 2 N k theta^2 and the plates are n L cos(theta) apart. The force is the quotient of their rates.
TEST(PaperPanels, SingleUnitPanelIsTheClosedFormUnderTheForceOfItsTurningSprings) {
  const Structure s = single_unit_panel();
  for (const double theta : {30 * radians_per_degree, 41 * radians_per_degree, -41 * radians_per_degree}) {
    const EquilibriumPath path = trace_equilibrium(driven(s, drive_to(s, theta)), {});
    ASSERT_EQ(path.stop, Stop::reached) << path.why;
    EXPECT_LE(from_closed_form(s, path), 2e-4);
    const double energy = planar_energy(s, 0.1, theta);
    EXPECT_NEAR(path.steps.back().energy, energy, 1e-4 * energy);
    const double force = 2 * energy / theta / (15 * s.size.edge_mm * std::sin(theta));
    EXPECT_NEAR(path.steps.back().load, force, 1e-3 * force);
    EXPECT_LE(path.gaps.max, 1e-5);
  }
}

/// Angle of each wall along x in a row against the line through the row's ends, rad.
std::vector<double> slopes(const Structure& s, const State& state, int row) {
  const auto at = [&](int i) { return state[*s.body_at({i, row})].p; };
  const auto angle = [](const Vector3d& v) { return std::atan2(v.y(), v.x()); };
  std::vector<double> out;
  for (int i = 0; i < 8; ++i) out.push_back(angle(at(i + 1) - at(i)) - angle(at(8) - at(0)));
  return out;
}

TEST(PaperPanels, GradientPanelShearsUpOnTheLeftAndDownOnTheRight) {
  const Structure s = gradient_panel();
  const EquilibriumPath path =
      trace_equilibrium(driven(s, plates_drive(Axis::x, 20 * radians_per_degree)), {});
  ASSERT_EQ(path.stop, Stop::reached) << path.why;
  for (const int row : {0, 4, 8}) {
    const auto slope = slopes(s, path.state, row);
    EXPECT_TRUE(std::is_sorted(slope.rbegin(), slope.rend()));
    EXPECT_GE(slope.front(), 15 * radians_per_degree);
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(slope[c], -slope[7 - c], 0.03 * slope.front());
  }
}

TEST(PaperPanels, GradientPanelStrainsItsHingesByAPercentOfACell) {
  const EquilibriumPath path =
      trace_equilibrium(driven(gradient_panel(), plates_drive(Axis::x, 20 * radians_per_degree)), {});
  EXPECT_GE(path.gaps.max, 5e-3);
  EXPECT_LE(path.gaps.max, 1.5e-2);
  double stretch = 0, turn = 0;
  for (const HingeEnergy& e : path.hinge_energies) {
    EXPECT_GE(std::min(e.stretch, e.turn), 0);
    stretch += e.stretch;
    turn += e.turn;
  }
  EXPECT_NEAR(stretch + turn, path.steps.back().energy, 1e-9 * path.steps.back().energy);
  EXPECT_GE(stretch, 5 * turn);
  for (std::size_t k = 1; k < path.steps.size(); ++k)
    EXPECT_GT(path.steps[k].energy, path.steps[k - 1].energy);
}

/// The mirror image in the x axis is the same panel folded to the other side.
TEST(PaperPanels, GradientPanelFoldedToTheOtherSideIsItsMirrorImage) {
  const Structure s = gradient_panel();
  const EquilibriumPath up = trace_equilibrium(driven(s, plates_drive(Axis::x, 20 * radians_per_degree)), {}),
                        down =
                            trace_equilibrium(driven(s, plates_drive(Axis::x, -20 * radians_per_degree)), {});
  EXPECT_NEAR(up.steps.back().energy, down.steps.back().energy, 1e-6);
  State mirrored(s.bodies.size());
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    const Pose& pose = down.state[*s.body_at({s.bodies[b].i, 8 - s.bodies[b].j})];
    mirrored[b].p = pose.p.cwiseProduct(Vector3d(1, -1, 1));
  }
  EXPECT_LE(aligned_distance(s, mirrored, up.state).max, 1e-6);
}

// ---- Fig. 20 ----

struct Pair {
  const char* name;
  ColumnUnit even, odd;
  Family family;
};

/// All without twisting units: the y-walls have t = 1/2, so these are F1, or F2 where a column bends.
const Pair exact_pairs[] = {
    {"basic + basic", basic_unit, basic_unit, Family::F1},
    {"basic + scaling", basic_unit, scaling_unit, Family::F1},
    {"basic + shearing", basic_unit, shearing_unit, Family::F1},
    {"scaling + scaling", scaling_unit, scaling_unit, Family::F1},
    {"scaling + shearing", scaling_unit, shearing_unit, Family::F1},
    {"shearing + shearing", shearing_unit, shearing_unit, Family::F1},
    {"bending + basic", bending_unit, basic_unit, Family::F2},
    {"bending + scaling", bending_unit, scaling_unit, Family::F2},
    {"bending + shearing", bending_unit, shearing_unit, Family::F2},
    {"bending + bending", bending_unit, bending_unit, Family::F2},
};

/// With twisting units, which no exact family holds: they only move by strain.
const Pair twisting_pairs[] = {
    {"twisting + basic", twisting_unit, basic_unit, Family::none},
    {"twisting + scaling", twisting_unit, scaling_unit, Family::none},
    {"twisting + shearing", twisting_unit, shearing_unit, Family::none},
    {"twisting + bending", twisting_unit, bending_unit, Family::none},
};

/// The screw that carries a body to the next of its kind along a row: turn rad, slip along its axis in cells.
struct Screw {
  double turn = 0, slip = 0;
  Vector3d axis;  ///< in the frame of the straight strip before it folds, up to the body's own turn theta
};

Screw screw_of_period(const Structure& s, const State& state, int from, double theta) {
  const Pose &a = state[*s.body_at({from, 0})], &b = state[*s.body_at({from + 2, 0})];
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(b.R * a.R.transpose()));
  const Eigen::AngleAxisd own(theta, Vector3d::UnitZ());
  return {turn.angle(), turn.axis().dot(b.p - a.p) / s.size.edge_mm, own * (a.R.transpose() * turn.axis())};
}

/// Angle between the z directions of two neighbouring bodies of a row, rad.
double lean(const Structure& s, const State& state, int column) {
  const Vector3d u = state[*s.body_at({column, 0})].R.col(2), v = state[*s.body_at({column + 1, 0})].R.col(2);
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

TEST(PaperTwoUnits, WithoutTwistingUnitsTheyMoveFreelyWithOneFreedom) {
  for (const Pair& pair : exact_pairs)
    for (const int rows : {1, 4}) {
      SCOPED_TRACE(pair.name);
      const Structure s = alternating(6, rows, pair.even, pair.odd);
      EXPECT_EQ(classify(s).family, pair.family);
      const Mobility m = mobility(s, {});
      EXPECT_EQ(m.verdict, Verdict::mobile) << m.why;
      EXPECT_EQ(m.dofs_flat, 1);
      EXPECT_EQ(m.dofs_along, 1);
    }
}

TEST(PaperTwoUnits, WithoutTwistingUnitsTheyFoldAsTheClosedForm) {
  for (const Pair& pair : exact_pairs)
    for (const int rows : {1, 4})
      for (const double theta : {30 * radians_per_degree, -30 * radians_per_degree}) {
        SCOPED_TRACE(pair.name);
        const Structure s = alternating(6, rows, pair.even, pair.odd);
        EXPECT_LE(error(s, theta, 0.1), 3e-3);
        EXPECT_LE(error(s, theta, 1e-3), 3e-5);
      }
}

TEST(PaperTwoUnits, PlanarUnitsStayInThePlaneAndKeepTheirDirection) {
  for (const Pair& pair : exact_pairs) {
    if (pair.family != Family::F1) continue;
    SCOPED_TRACE(pair.name);
    const Structure s = alternating(6, 1, pair.even, pair.odd);
    const EquilibriumPath path = driven(s, 30 * radians_per_degree, 1e-3);
    EXPECT_TRUE(path.planar);
    for (const int from : {0, 2, 4}) EXPECT_LE(screw_of_period(s, path.state, from, path.theta).turn, 1e-4);
  }
}

/// Kinematics section 2: one bending column folds by 2 psi about y, a planar one slides by (2 t - 1)
/// sin(theta).
TEST(PaperTwoUnits, BendingUnitsBendWithBasicOnesCurlWithShearedOnesAndCancelAmongThemselves) {
  const double theta = 30 * radians_per_degree, turn = crease_fold(bend_tilt, theta);
  const auto screw = [&](const ColumnUnit& odd) {
    const Structure s = alternating(6, 1, bending_unit, odd);
    return screw_of_period(s, driven(s, theta, 1e-3).state, 2, theta);
  };
  for (const auto& [odd, slip] : {std::pair{basic_unit, 0.0}, {scaling_unit, -0.2}, {shearing_unit, 0.2}}) {
    const Screw s = screw(odd);
    EXPECT_NEAR(s.turn, turn, 1e-4);
    EXPECT_NEAR(s.slip, slip, 1e-4);
    EXPECT_NEAR(s.slip, (2 * odd.t - 1) * std::sin(theta), 1e-4);
    EXPECT_NEAR(std::abs(s.axis.y()), 1, 1e-4);
  }
  EXPECT_LE(screw(bending_unit).turn, 1e-4);
}

/// A sheet of both: the cells with the same fractions along x and y scale, the others shear.
TEST(PaperTwoUnits, CheckerboardOfScalingAndShearingCellsDoesBoth) {
  const double k = 0.3, theta = 22.5 * radians_per_degree;
  auto design = ExactDesign<double>::basic(6, 4);
  for (int c = 0; c < 6; ++c) design.t[c] = c % 2 == 0 ? k : 1 - k;
  for (int r = 0; r < 4; ++r) design.s[r] = r % 2 == 0 ? k : 1 - k;
  Structure s = make_structure(rectangle(6, 4), {});
  apply(design, s);
  const EquilibriumPath path = driven(s, theta, 1e-3);
  ASSERT_EQ(path.stop, Stop::reached) << path.why;
  const double shear = 2 * std::atan((1 - 2 * k) * std::tan(theta));
  for (std::size_t c = 0; c < s.cells.size(); ++c) {
    const auto& bodies = s.cell_members[c].bodies;
    const Vector3d x = path.state[bodies[1]].p - path.state[bodies[0]].p,
                   y = path.state[bodies[3]].p - path.state[bodies[0]].p;
    const double angle = std::atan2(x.cross(y).z(), x.dot(y));
    const bool scales = (s.cells[c].i + s.cells[c].j) % 2 == 0;
    EXPECT_NEAR(std::abs(angle - pi / 2), scales ? 0 : shear, 1e-4);
    EXPECT_NEAR(x.norm() * y.norm() / 100, area_ratio(k, 2 * theta), 1e-4);
  }
}

TEST(PaperTwoUnits, TwistingUnitsMakeStripsAndSheetsRigidAtFlat) {
  for (const Pair& pair : twisting_pairs)
    for (const int rows : {1, 4}) {
      SCOPED_TRACE(pair.name);
      const Structure s = alternating(6, rows, pair.even, pair.odd);
      const Mobility m = mobility(s, exact_motion(s));
      EXPECT_EQ(m.verdict, Verdict::not_mobile) << m.why;
      EXPECT_EQ(m.dofs_flat, 0);
    }
}

/// Over a barrier to the twisted state of Eq. 6, at theta = 45 deg, where all hinges close again.
TEST(PaperTwoUnits, TwistingUnitsSnapToTheTwistOfEquationSixAndTheOthersDoTheirPart) {
  const double theta = 45 * radians_per_degree, twist = std::abs(pi - twist_angle(twist_alpha));
  for (const Pair& pair : twisting_pairs) {
    SCOPED_TRACE(pair.name);
    const Structure s = alternating(6, 1, pair.even, pair.odd);
    const EquilibriumPath path =
        trace_equilibrium(driven(s, hinge_drive(s, {{3, 0}, Axis::y}, theta)), {.k_turn = 1e-3}, no_contact);
    ASSERT_EQ(path.stop, Stop::reached) << path.why;
    const double fold = crease_fold(pair.odd.beta, theta);
    for (const int c : {0, 2, 4}) EXPECT_NEAR(lean(s, path.state, c), twist, 1e-4);
    for (const int c : {1, 3, 5}) EXPECT_NEAR(lean(s, path.state, c), fold, 1e-4);
    const Closure closed = solve_closure(s, path.state, {});
    EXPECT_TRUE(closed.closed) << closed.why;
    EXPECT_LE(aligned_distance(s, path.state, closed.state).rms, 2e-3);
    double barrier = 0;
    for (const EquilibriumStep& step : path.steps) barrier = std::max(barrier, step.energy);
    EXPECT_GE(barrier, 1000 * path.steps.back().energy);
  }
}

/// The axis of the screw of one period is the strip's own, and it does not bend.
TEST(PaperTwoUnits, TwistingAndBasicUnitsTwistAboutTheStrip) {
  const Structure s = twisting_strip();
  const EquilibriumPath path = trace_equilibrium(
      driven(s, hinge_drive(s, {{5, 0}, Axis::y}, 44.9 * radians_per_degree)), {.k_turn = 1e-4}, no_contact);
  ASSERT_EQ(path.stop, Stop::reached) << path.why;
  for (const int from : {0, 2, 4, 6}) {
    const Screw screw = screw_of_period(s, path.state, from, path.theta);
    EXPECT_NEAR(screw.turn, std::abs(pi - twist_angle(twist_alpha)), 1e-2);
    EXPECT_GE(std::abs(screw.slip), 0.99 * 2 * std::cos(path.theta));
  }
}

/// Alone, twisting units want to twist one up and the next down the other way at the other sign of theta.
TEST(PaperTwoUnits, TwistingUnitsAloneWorkAgainstEachOther) {
  const Structure s = alternating(6, 1, twisting_unit, twisting_unit);
  const EquilibriumPath path = trace_equilibrium(
      driven(s, hinge_drive(s, {{3, 0}, Axis::y}, 45 * radians_per_degree)), {.k_turn = 1e-3}, no_contact);
  EXPECT_GE(path.gaps.max, 1e-2);
  EXPECT_FALSE(solve_closure(s, path.state, {HingeTurn{*s.hinge_at({{3, 0}, Axis::y}), pi / 2}}).closed);
}

// ---- Figs. 15 to 19 ----

TEST(PaperTessellations, BendingStripBendingSheetAndCurlingSheetAreTheClosedForm) {
  for (const Structure& s : {bending_strip(), bending_sheet(), curling_sheet()})
    for (const double theta : {35 * radians_per_degree, -35 * radians_per_degree}) {
      EXPECT_LE(error(s, theta, 1e-3), 2e-4);
      EXPECT_EQ(mobility(s, exact_motion(s)).verdict, Verdict::mobile);
    }
}

/// With contact they go as far as without, and nothing touches where the closed form does not.
TEST(PaperTessellations, DoNotTouchBeforeTheClosedFormDoes) {
  for (const Structure& s : {bending_strip(), bending_sheet(), curling_sheet()}) {
    const double limit = theta_range(s, exact_motion(s)).positive.theta;
    const EquilibriumPath path =
        trace_equilibrium(driven(s, drive_to(s, limit - 1 * radians_per_degree)), {.k_turn = 1e-3});
    ASSERT_EQ(path.stop, Stop::reached) << path.why;
    EXPECT_FALSE(first_event(path, Kind::contact));
    EXPECT_LE(from_closed_form(s, path), 1e-3);
  }
}

TEST(PaperTessellations, CurlingStripOfBendingAndTwistingUnitsBendsAndTwists) {
  const Structure s = curling_strip();
  const EquilibriumPath path = trace_equilibrium(
      driven(s, hinge_drive(s, {{4, 0}, Axis::y}, -45 * radians_per_degree)), {.k_turn = 1e-3}, no_contact);
  ASSERT_EQ(path.stop, Stop::reached) << path.why;
  for (int c = 0; c < 9; ++c)
    EXPECT_NEAR(lean(s, path.state, c),
                c % 2 == 0 ? crease_fold(bend_tilt, 45 * radians_per_degree)
                           : std::abs(pi - twist_angle(twist_alpha)),
                1e-3);
  const Screw screw = screw_of_period(s, path.state, 2, path.theta);
  EXPECT_GE(screw.turn, 40 * radians_per_degree);
  EXPECT_GE(std::abs(screw.slip), 0.1);
}

}  // namespace
}  // namespace kinetix::model
