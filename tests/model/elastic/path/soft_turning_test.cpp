#include <gtest/gtest.h>

#include "model/closure/closure.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/elastic/path/measured_system.hpp"
#include "model/elastic/path/turning_points.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/random_designs.hpp"

/// Tests of sheets with an exact motion whose hinges turn almost freely. Their state and load are known in closed form.
/// Both signs of theta cost the same energy, so only the requested sign distinguishes the sides.
namespace kinetix::model {
namespace {

using namespace testing;
using testing::hinge_drive;
using Kind = PathEvent::Kind;
using Stop = EquilibriumPath::Stop;

const double requested_theta = std::acos(0.95);  // rad: plates that close in by 5 %

/// Returns a sheet whose every second column tilts by 20 deg, alternating from row to row.
Structure bending_sheet(int cells, double edge_mm = 10) {
  auto design = ExactDesign<double>::basic(cells, cells);
  for (int c = 0; c < cells; c += 2) design.beta[c] = 20 * radians_per_degree;
  return structure_of(design, {.edge_mm = edge_mm});
}

/// Returns the energy of the turning springs on the closed form, N mm.
double turning_energy(const Structure& s, const Elasticity& elasticity, double theta) {
  const State state = fold(classify(s), s, theta);
  double sum = 0;
  for (const RestHinge& h : Linkage(s).hinges)
    sum +=
        hinge_energy(h, relative(elasticity, s.size.edge_mm), state[h.lower], state[h.upper], s.size.edge_mm)
            .turn;
  return sum * energy_unit(elasticity, s.size.edge_mm);
}

/// Returns the derivative of turning_energy() by theta, N mm.
double turning_slope(const Structure& s, const Elasticity& elasticity, double theta) {
  constexpr double step = 1e-4;  // rad: its square is below the accuracy asked, rounding too
  return (turning_energy(s, elasticity, theta + step) - turning_energy(s, elasticity, theta - step)) /
         (2 * step);
}

/// Force on plates that are `height` mm apart when flat, N.
double plates_force(const Structure& s, const Elasticity& elasticity, double theta, double height) {
  return turning_slope(s, elasticity, theta) / (height * std::sin(theta));
}

struct SoftCase {
  int cells;
  double ratio;  ///< k_turn by k_point edge^2
  Axis axis;
  int sign;
};

/// Returns cases with every axis and sign. @param ratios for each size of sheet up to 12 cells and for 32 cells
std::vector<SoftCase> soft_cases(const std::vector<double>& ratios, const std::vector<int>& sizes,
                                 const std::vector<double>& ratios_of_largest) {
  std::vector<SoftCase> cases;
  const auto add = [&](int cells, double ratio) {
    for (const Axis axis : {Axis::x, Axis::y})
      for (const int sign : {1, -1}) cases.push_back({cells, ratio, axis, sign});
  };
  for (const double ratio : ratios)
    for (const int cells : sizes) add(cells, ratio);
  for (const double ratio : ratios_of_largest) add(32, ratio);
  return cases;
}

/// Plates normal to x need columns that stay in a plane: a sheet of basic cells.
void expect_the_side_asked(const std::vector<SoftCase>& cases) {
  for (const auto& [cells, ratio, axis, sign] : cases) {
    SCOPED_TRACE(::testing::Message() << cells << " cells, ratio " << ratio << ", axis "
                                      << (axis == Axis::x ? "x" : "y") << ", sign " << sign);
    const Structure s = axis == Axis::y ? bending_sheet(cells) : make_structure(rectangle(cells, cells), {});
    const Elasticity elasticity{.k_turn = ratio * 1e5};
    const EquilibriumPath path = trace_equilibrium(driven(s, plates_drive(axis, sign * requested_theta)),
                                                   elasticity, without_contact());
    ASSERT_EQ(path.stop, Stop::reached) << path.why;
    EXPECT_TRUE(path.steps.back().stable);
    // The springs pull the sheet off its closed form in proportion to their stiffness and its size squared.
    const double slack = 5 * ratio * (10 + cells * cells) + 1e-12;
    EXPECT_LE(from_closed_form(s, path), slack);
    // Bodies of halved walls have the same positions on both sides. Only their turns show which side it is.
    EXPECT_LE(turn_distance(s, path.state, fold(classify(s), s, path.theta)), 20 * slack);
    const double force = plates_force(s, elasticity, sign * requested_theta, 10.0 * cells);
    EXPECT_NEAR(path.steps.back().load, force, 1e-5 * force);
    for (const PathEvent& event : path.events) EXPECT_EQ(event.kind, Kind::bifurcation) << event.what;
    EXPECT_TRUE(limit_points(path).empty());
  }
}

TEST(SoftTurning, BetweenPlatesFoldsToTheSideAsked) {
  expect_the_side_asked(soft_cases({1e-6, 1e-8, 1e-10, 1e-12, 1e-14}, {1, 2, 3, 8}, {}));
  expect_the_side_asked(soft_cases({1e-7, 1e-14}, {12}, {}));
}

TEST(SoftTurningSoak, BetweenPlatesFoldsToTheSideAsked) {
  expect_the_side_asked(soft_cases({1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14},
                                   {1, 2, 3, 6, 8, 12}, {1e-6, 1e-7, 1e-9, 1e-14}));
}

struct Pins {
  int cells;
  double edge_mm;
  Elasticity elasticity;
};

const Elasticity stiff_pins{.k_point = 1e5,   // N/mm: pins that hardly open
                            .k_turn = 0.01};  // N mm/rad: soft enough to fold

void expect_the_side_asked(const std::vector<Pins>& cases) {
  for (const auto& [cells, edge_mm, elasticity] : cases)
    for (const int side : {1, -1})
      for (const int sign : {1, -1}) {
        const Structure s = bending_sheet(cells, edge_mm);
        EquilibriumPathOptions options;
        options.side = side;
        const EquilibriumPath path =
            trace_equilibrium(driven(s, plates_drive(Axis::y, sign * requested_theta)), elasticity, options);
        EXPECT_EQ(path.stop, Stop::reached) << path.why;
        EXPECT_LE(from_closed_form(s, path), 1e-6)
            << cells << " cells of " << edge_mm << " mm, sign " << sign;
      }
}

TEST(SoftTurning, OfLargeCellsAndStiffPinsFoldsToTheSideAsked) {
  expect_the_side_asked(std::vector<Pins>{{3, 300, {}}, {6, 10, stiff_pins}, {8, 10, stiff_pins}});
}

TEST(SoftTurningSoak, OfLargeCellsAndStiffPinsFoldsToTheSideAsked) {
  expect_the_side_asked(std::vector<Pins>{{12, 10, stiff_pins}});
}

/// Each cell may fold to either side independently, whatever the springs.
TEST(SoftTurning, OfTwoCellsThatShareACornerFoldsBothToTheSideAsked) {
  const Structure s = make_structure({{0, 0}, {1, 1}}, {});
  for (const double k_turn : {1.0, 0.1, 1e-3, 1e-7})
    for (const int sign : {1, -1}) {
      const EquilibriumPath path = trace_equilibrium(driven(s, plates_drive(Axis::y, sign * requested_theta)),
                                                     {.k_turn = k_turn}, without_contact());
      ASSERT_EQ(path.stop, Stop::reached) << path.why;
      EXPECT_LE(turn_distance(s, path.state, fold(classify(s), s, path.theta)), 0.02)
          << k_turn << ", " << sign;
    }
}

/// Folds fifty columns that turn by 180 deg in all.
void expect_half_cylinder(int rows) {
  constexpr int cells = 50;
  auto design = ExactDesign<double>::basic(cells, rows);
  const double theta = 30 * radians_per_degree, tilt = tilt_of_turn(pi / (cells / 2), theta);
  for (int c = 0; c < cells; c += 2) design.beta[c] = tilt;
  const Structure s = structure_of(design);
  for (const auto& [ratio, sign] : {std::pair(1e-8, 1), std::pair(1e-12, -1)}) {
    const Elasticity elasticity{.k_turn = ratio * 1e5};
    const EquilibriumPath path =
        trace_equilibrium(driven(s, plates_drive(Axis::y, sign * theta)), elasticity, without_contact());
    ASSERT_EQ(path.stop, Stop::reached) << path.why;
    EXPECT_LE(from_closed_form(s, path), 1e-3) << ratio << ", sign " << sign;
    const double force = plates_force(s, elasticity, sign * theta, 10.0 * rows);
    EXPECT_NEAR(path.steps.back().load, force, 1e-3 * force) << ratio << ", sign " << sign;
  }
}

TEST(SoftTurning, OfAHalfCylinderFoldsToTheSideAsked) { expect_half_cylinder(8); }

TEST(SoftTurningSoak, OfAHalfCylinderFoldsToTheSideAsked) { expect_half_cylinder(50); }

TEST(SoftTurning, OfADrivenHingeBringsNoEvents) {
  const Structure s = bending_sheet(8);
  for (const double k_turn : {1e-2, 1e-4, 1e-7, 1e-9})
    for (const int sign : {1, -1}) {
      const Elasticity elasticity{.k_turn = k_turn};
      const double theta = sign * requested_theta;
      const EquilibriumPath path = trace_equilibrium(driven(s, hinge_drive(s, {{1, 3}, Axis::y}, theta)),
                                                     elasticity, without_contact());
      ASSERT_EQ(path.stop, Stop::reached) << path.why;
      EXPECT_LE(from_closed_form(s, path), 1e-4 * k_turn / 1e-2 + 1e-8);
      for (const PathEvent& event : path.events) ADD_FAILURE() << k_turn << ": " << event.what;
      EXPECT_TRUE(limit_points(path).empty()) << k_turn;
      for (std::size_t k = 1; k < path.steps.size(); ++k) {
        const EquilibriumStep& step = path.steps[k];
        const double by_turn = turning_slope(s, elasticity, step.theta) / (step.drive / step.theta);
        EXPECT_NEAR(step.load, by_turn, 1e-2 * std::abs(by_turn)) << k_turn << " at " << step.theta;
        EXPECT_GT(step.load * step.drive, 0);
      }
    }
}

TEST(SoftTurning, BetweenPlatesLoadsAreThoseOfTheTurningSpringsAllTheWay) {
  const Structure s = bending_sheet(8);
  for (const double k_turn : {1e-4, 1e-8, 1e-10}) {
    const Elasticity elasticity{.k_turn = k_turn};
    const EquilibriumPath path =
        trace_equilibrium(driven(s, plates_drive(Axis::y, requested_theta)), elasticity, without_contact());
    ASSERT_EQ(path.stop, Stop::reached) << path.why;
    for (std::size_t k = 1; k < path.steps.size(); ++k) {
      const double force = plates_force(s, elasticity, path.steps[k].theta, 80);
      EXPECT_NEAR(path.steps[k].load, force, 1e-2 * force) << k_turn << " at " << path.steps[k].theta;
    }
  }
}

struct Settled {
  ElasticSystem system;
  TangentStiffness tangent;
  State state;

  Settled(const Structure& s, const Drive& drive, double k_turn)
      : system(s, {.k_turn = k_turn}, drive_on(s, drive), false, false),
        tangent(system.dofs()),
        state(trace_equilibrium(driven(s, drive), {.k_turn = k_turn}, without_contact()).state) {
    state = at(drive_on(s, drive).theta());
  }

  /// The equilibrium at a theta nearby, rad, whose tangent is then that of the system.
  State at(double theta) {
    State moved = state;
    system.place(theta, moved);
    NewtonOptions options;
    options.force_tolerance = 0;
    EXPECT_TRUE(minimise(system, theta, options, moved, tangent).stable);
    return moved;
  }
};

/// With stiff springs, the force on the driven part is equally accurate.
TEST(DriveLoad, IsTheForceOnWhatIsDriven) {
  const Structure s = bending_sheet(4);
  for (const Drive& drive :
       {plates_drive(Axis::y, 0.4), plates_drive(Axis::y, -0.3), hinge_drive(s, {{1, 1}, Axis::y}, 0.4),
        hinge_drive(s, {{1, 1}, Axis::x}, -0.3)}) {
    Settled at(s, drive, 20);
    const double theta = at.system.drive().theta(), load = at.system.load(at.state, theta);
    EXPECT_NEAR(load_along_path(at.system, at.state, theta, at.tangent), load, 1e-8 * std::abs(load));
  }
}

/// A driven hinge gives way by the structure's stiffness over that of its grip: its own turn sets the scale.
TEST(PathDirection, IsThatBetweenTwoStatesOfThePath) {
  const Structure s = bending_sheet(4);
  constexpr double theta = 0.4, step = 1e-3;  // rad; differences are off by the step squared
  for (const bool plates : {true, false}) {
    Settled at(s, plates ? plates_drive(Axis::y, theta) : hinge_drive(s, {{1, 1}, Axis::y}, theta), 20);
    Eigen::VectorXd along =
        path_direction(at.system, at.state, theta, theta, at.tangent) + at.system.place_rate(theta);
    if (!plates)
      along *= at.system.drive().coordinate_rate(theta) / at.system.driven_gradient(at.state).dot(along);
    const State before = at.at(theta - step), after = at.at(theta + step);
    for (std::size_t b = 0; b < at.state.size(); ++b) {
      const Eigen::Vector3d moved = (after[b].p - before[b].p) / (2 * step * s.size.edge_mm);
      const Eigen::AngleAxisd turned(after[b].R * before[b].R.transpose());
      EXPECT_LE((moved - along.segment<3>(6 * b + 3)).norm(), 1e-5);
      EXPECT_LE((turned.angle() * turned.axis() / (2 * step) - along.segment<3>(6 * b)).norm(), 1e-5);
    }
  }
}

}  // namespace
}  // namespace kinetix::model
