#include <gtest/gtest.h>
#include <cmath>
#include <functional>

#include "model/base/invalid_input.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/elastic/adjoint.hpp"
#include "model/elastic/path/stable_states.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "tests/support/derivatives.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/paper_scenes.hpp"
#include "tests/support/random_elastic.hpp"

/// Tests of drives that act on hinges: a tendon through some, or a shape-memory spring in each.
namespace kinetix::model {
namespace {

using namespace testing;
using Eigen::VectorXd;
using Stop = EquilibriumPath::Stop;

/// Returns the hinges of the walls across a row of cells.
std::vector<int> across_row(const Structure& s, int row, int columns) {
  std::vector<int> through;
  for (int i = 0; i <= columns; ++i) through.push_back(*s.hinge_at({{i, row}, Axis::y}));
  return through;
}

/// Returns the hinges on a tendon that goes up, across and back, and passes one hinge twice.
std::vector<int> winding(const Structure& s) {
  const auto at = [&](int i, int j, Axis axis) { return *s.hinge_at({{i, j}, axis}); };
  return {at(0, 0, Axis::x), at(1, 0, Axis::y), at(0, 1, Axis::x),
          at(2, 1, Axis::y), at(1, 0, Axis::y), at(2, 2, Axis::x)};
}

Structure basic_sheet(int columns, int rows) { return make_sheet(columns, rows, {10, 0.8, 6}); }

VectorXd zeros(const State& state) { return VectorXd::Zero(6 * static_cast<Eigen::Index>(state.size())); }

/// Returns the tendon's Hessian, spread over the twists of all bodies.
Eigen::MatrixXd spread(const CordElement& cord, std::size_t bodies) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(6 * bodies, 6 * bodies);
  for (std::size_t a = 0; a < cord.bodies.size(); ++a)
    for (std::size_t b = 0; b < cord.bodies.size(); ++b)
      all.block<6, 6>(6 * cord.bodies[a], 6 * cord.bodies[b]) = cord.hessian.block<6, 6>(6 * a, 6 * b);
  return all;
}

TEST(CordElement, HasTheCentralDifferencesOfItsLengthAsDerivatives) {
  for (const auto& [seed, size] : {std::pair{1u, 0.0}, {2u, 0.3}}) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", moved by " + std::to_string(size));
    std::mt19937 random(seed);
    const Structure s = random_panel(3, 2, random);
    const std::vector<int> through = winding(s);
    const State state = shaken(s, rest_state(s), size, random);
    const Linkage linkage = s;
    const CordElement cord = cord_element(linkage, through, state);
    const auto length = [&](const VectorXd& x) {
      const State moved = retract_straight(linkage, state, x);
      return VectorXd::Constant(1, cord_length(linkage, through, moved) / s.size.edge_mm);
    };
    const VectorXd gradient = cord_gradient(linkage, through, state);
    expect_jacobian(length, zeros(state), gradient.transpose());
    // The Hessian comes from second differences of the length along the twists, since turns do not add up.
    const auto along = [&](const VectorXd& x) -> VectorXd {
      return numeric_jacobian([&](const VectorXd& y) { return length(x + y); }, zeros(state), 3e-3)
          .transpose();
    };
    expect_jacobian(along, zeros(state), spread(cord, state.size()), 1e-5, 3e-3);
  }
}

/// Checks energy, gradient and Hessian of the whole system, off equilibrium and with a force on the held coordinate.
void expect_derivatives(const Structure& s, const LinkageDrive& drive, std::mt19937& random) {
  ElasticSystem system(s, Elasticity{1000, 20, 3, 3000}, drive, false, false);
  system.set_multiplier(-0.02);
  const double theta = 0.4;
  const State state = shaken(s, rest_state(s), 0.2, random);
  TangentStiffness tangent(system.dofs());
  const VectorXd gradient = system.linearise(state, theta, tangent);
  EXPECT_LE((gradient - system.gradient(state, theta)).norm(), 1e-12 * gradient.norm());
  const auto energy = [&](const VectorXd& x) {
    return VectorXd::Constant(1, system.energy(retract_straight(s, state, x), theta));
  };
  expect_jacobian(energy, zeros(state), gradient.transpose());
  Eigen::MatrixXd hessian(gradient.size(), gradient.size());
  for (Eigen::Index k = 0; k < gradient.size(); ++k)
    hessian.col(k) = tangent.multiply_all(VectorXd::Unit(gradient.size(), k));
  const auto along = [&](const VectorXd& x) -> VectorXd {
    return numeric_jacobian([&](const VectorXd& y) { return energy(x + y); }, zeros(state), 3e-3).transpose();
  };
  expect_jacobian(along, zeros(state), hessian, 1e-4, 3e-3);
}

TEST(Cord, HoldsTheSheetByAnEnergyWhoseDerivativesAreItsCentralDifferences) {
  std::mt19937 random(4);
  const Structure s = random_panel(2, 2, random);
  expect_derivatives(s, cord_drive(s, across_row(s, 0, 2), 3), random);
}

TEST(ShapeMemory, HasAnEnergyWhoseDerivativesAreItsCentralDifferences) {
  std::mt19937 random(5);
  const Structure s = random_panel(2, 2, random);
  expect_derivatives(s, shape_memory_drive(s, {0, 3, 7}, 50, 40 * radians_per_degree), random);
}

TEST(ShapeMemory, LoadIsTheDerivativeOfTheEnergyByTheDriveAndTheirsByTheStateAreOne) {
  std::mt19937 random(6);
  const Structure s = random_panel(2, 2, random);
  const LinkageDrive drive = shape_memory_drive(s, {}, 50, 40 * radians_per_degree);
  const ElasticSystem system(s, Elasticity{}, drive, false, false);
  const State state = shaken(s, rest_state(s), 0.2, random);
  const auto by_theta = [&](const VectorXd& x) { return VectorXd::Constant(1, system.energy(state, x[0])); };
  expect_jacobian(by_theta, VectorXd::Constant(1, 0.3),
                  VectorXd::Constant(1, system.load(state, 0.3) * system.drive().coordinate_rate(0.3)));
  const auto load = [&](const VectorXd& x) {
    return VectorXd::Constant(1, system.load(retract_straight(s, state, x), 0.3));
  };
  expect_jacobian(load, zeros(state), system.spring_gradient(state).transpose());
}

/// The alloy's springs and the hinges turn by the same angle, and stop where their moments are equal.
TEST(ShapeMemory, FoldsAnExactSheetAsFarAsTheHingesYield) {
  const Structure s = basic_sheet(4, 3);
  const double k_hinge = 2, k_spring = 5, angle = 40 * radians_per_degree,
               hinges = static_cast<double>(s.hinges.size());
  const LinkageDrive drive = shape_memory_drive(s, {}, k_spring, angle);
  Elasticity elasticity;
  elasticity.k_turn = k_hinge;
  const DrivenLinkage driven{s, drive, exact_motion(s)};
  const EquilibriumPath path = trace_equilibrium(driven, elasticity);
  EXPECT_EQ(path.stop, Stop::reached) << path.why;
  const double turn = angle * k_spring / (k_spring + k_hinge), k = k_spring * k_hinge / (k_spring + k_hinge);
  EXPECT_NEAR(mean_theta(s, path.state), turn / 2, 1e-9);
  EXPECT_NEAR(exact_theta(driven, elasticity), turn / 2, 1e-7);
  EXPECT_LE(from_closed_form(s, path.state, turn / 2), 1e-8);
  const EquilibriumStep& last = path.steps.back();
  EXPECT_NEAR(last.drive, angle, 1e-12);
  EXPECT_NEAR(last.energy, hinges * k * angle * angle / 2, 1e-9 * last.energy);
  EXPECT_NEAR(last.load, hinges * k * angle, 1e-9 * last.load);
  EXPECT_NEAR(last.springs, hinges * k_spring / 2 * std::pow(angle - turn, 2), 1e-9 * last.energy);
  EXPECT_TRUE(path.events.empty());
}

TEST(ShapeMemory, FoldsToTheSideOfItsAngle) {
  const Structure s = basic_sheet(2, 2);
  const auto folded = [&](double angle) {
    const LinkageDrive drive = shape_memory_drive(s, {}, 5, angle);
    return mean_theta(s, trace_equilibrium({s, drive, exact_motion(s)}, {}).state);
  };
  EXPECT_NEAR(folded(-0.6), -folded(0.6), NewtonOptions{}.step_tolerance);
  EXPECT_GT(folded(0.6), 0.29);
}

/// A straight tendon across an even number of cells has cos(theta) times its flat length. Its tension follows from
/// virtual work.
TEST(Cord, FoldsAnExactSheetByTheTensionThatDoesTheWork) {
  const Structure s = basic_sheet(4, 3);
  Elasticity elasticity;
  elasticity.k_turn = 0.2;
  const double theta = 25 * radians_per_degree, rest = 4 * s.size.edge_mm,
               hinges = static_cast<double>(s.hinges.size());
  for (const int branch : {1, -1}) {
    const LinkageDrive drive = cord_drive(s, across_row(s, 1, 4), rest * (1 - std::cos(theta)), branch);
    EXPECT_NEAR(drive.theta(), branch * theta, 1e-12);
    const EquilibriumPath path = trace_equilibrium({s, drive, exact_motion(s)}, elasticity);
    EXPECT_EQ(path.stop, Stop::reached) << path.why;
    EXPECT_LE(from_closed_form(s, path.state, branch * theta), 2e-3);
    EXPECT_NEAR(cord_length(s, drive.through, path.state), rest * std::cos(theta), 1e-9);
    const EquilibriumStep& last = path.steps.back();
    EXPECT_NEAR(last.drive, drive.shorten_mm, 1e-9);
    EXPECT_NEAR(last.energy, planar_energy(s, elasticity.k_turn, theta), 2e-3 * last.energy);
    const double tension = hinges * 4 * elasticity.k_turn * theta / (rest * std::sin(theta));
    EXPECT_NEAR(last.load, tension, 5e-3 * tension);
    EXPECT_NE(first_event(path, PathEvent::Kind::bifurcation), nullptr) << "flat pulls to no side";
  }
}

/// A tendon across one cell has cos(theta) + sin(theta) times its flat length, or cos - sin on the other side. It pulls
/// to one side from the start.
TEST(Cord, AcrossAnOddNumberOfCellsPullsToTheSideThatIsShorter) {
  const Structure s = basic_sheet(1, 2);
  const double theta = 20 * radians_per_degree, L = s.size.edge_mm;
  const LinkageDrive drive =
      cord_drive(s, across_row(s, 0, 1), L * (1 - std::cos(theta) + std::sin(theta)), 1);
  const ExactMotion exact = exact_motion(s);
  const double found = exact.theta_of(drive);
  EXPECT_NEAR(std::abs(found), theta, 1e-9);
  EXPECT_NEAR(cord_length(s, drive.through, exact.at(found)), drive.rest_mm - drive.shorten_mm, 1e-9);
  const EquilibriumPath path = trace_equilibrium({s, drive, exact}, {});
  EXPECT_EQ(path.stop, Stop::reached) << path.why;
  EXPECT_NEAR(mean_theta(s, path.state), found, 1e-3);
}

/// A strip that curls up brings its ends near each other and apart again. A tendon between them is equally short at two
/// folds, or at many.
TEST(Cord, TakesTheFirstFoldAtWhichItIsShortEnoughHoweverShortlyItIs) {
  const double tilt = 40 * radians_per_degree;
  const Structure s = alternating(8, 1, {.beta = tilt}, {.beta = -tilt});
  const ExactMotion exact = exact_motion(s);
  const std::vector<int> through = {*s.hinge_at({{0, 0}, Axis::x}), *s.hinge_at({{7, 1}, Axis::x})};
  const double rest = cord_drive(s, through, 1).rest_mm;
  const auto length = [&](double theta) { return cord_length(s, through, exact.at(theta)); };
  constexpr double step = 0.1 * radians_per_degree;
  double lowest = 2 * step;
  while (!(length(lowest) < length(lowest - step) && length(lowest) <= length(lowest + step))) {
    lowest += step;
    ASSERT_LT(lowest, 1.2) << "there is no dip";
  }
  for (const double above_mm : {1.0, 0.1, 0.01, 1e-4}) {
    const double asked = length(lowest) + above_mm;
    const LinkageDrive drive = cord_drive(s, through, rest - asked, 1);
    const auto found = theta_of_cord(drive, s, exact.at);
    ASSERT_TRUE(found);
    EXPECT_NEAR(length(*found), asked, 1e-9);
    EXPECT_LE(std::abs(*found), lowest + step);
    EXPECT_GE(length(std::abs(*found) - step / 10), asked);
  }
}

TEST(Cord, WorkOfTheTensionIsTheEnergyOfASheetThatStrains) {
  const Structure s = alternating(4, 4, twisting_unit, basic_unit);
  const LinkageDrive drive = cord_drive(s, across_row(s, 1, 4), 5);
  EquilibriumPathOptions options;
  options.longest_step = options.first_step = 0.01;
  const EquilibriumPath path = trace_equilibrium({s, drive, exact_motion(s)}, {}, options);
  EXPECT_EQ(path.stop, Stop::reached) << path.why;
  double work = path.steps[1].energy;
  for (std::size_t k = 2; k < path.steps.size(); ++k)
    work +=
        (path.steps[k].drive - path.steps[k - 1].drive) * (path.steps[k].load + path.steps[k - 1].load) / 2;
  EXPECT_NEAR(work, path.steps.back().energy, 5e-3 * work);
}

Structure twisting_cell() {
  CellTuple twist;
  twist.A_in = {pi / 2, twist_alpha, pi / 2, twist_alpha};
  return tiled(1, 1, twist, {}, {20, 0.4, 8});
}

/// Past its barrier the cell continues without the tendon.
TEST(Cord, ThatWouldHaveToPushIsSaidToGoSlack) {
  const Structure s = twisting_cell();
  Elasticity soft;
  soft.k_turn = 1e-3;
  const auto traced = [&](double shorten_mm) {
    return trace_equilibrium({s, cord_drive(s, across_row(s, 0, 1), shorten_mm), {}}, soft);
  };
  EXPECT_EQ(first_event(traced(8), PathEvent::Kind::slack), nullptr);
  const EquilibriumPath path = traced(14);
  EXPECT_EQ(path.stop, Stop::reached) << path.why;
  EXPECT_LT(path.steps.back().load, -1);
  const PathEvent* slack = first_event(path, PathEvent::Kind::slack);
  ASSERT_NE(slack, nullptr);
  EXPECT_LT(slack->at.load, 0);
  EXPECT_GT(slack->at.drive, 8);
}

/// All drives take a twisting cell over the same barrier.
TEST(Drives, OfAllKindsFindTheSameStableStatesAndBarrier) {
  const Structure s = twisting_cell();
  Elasticity soft;
  soft.k_turn = 1e-3;
  StableStateOptions options;
  options.path = without_contact();  // walls in contact make several minima of the one
  const LinkageDrive hinge =
      drive_on(s, testing::hinge_drive(s, {{0, 0}, Axis::y}, -40 * radians_per_degree));
  const StableStates by_hinge = find_stable_states({{s, hinge, {}}}, soft, options);
  ASSERT_EQ(by_hinge.states.size(), 2u);
  ASSERT_EQ(by_hinge.barriers.size(), 1u);
  const LinkageDrive cord = cord_drive(s, across_row(s, 0, 1), 14);
  const LinkageDrive springs = shape_memory_drive(s, {}, 100, -90 * radians_per_degree);
  for (const LinkageDrive& drive : {cord, springs}) {
    const StableStates found = find_stable_states({{s, drive, {}}}, soft, options);
    SCOPED_TRACE(drive.coordinate_unit());
    ASSERT_EQ(found.states.size(), 2u);
    ASSERT_EQ(found.barriers.size(), 1u);
    // With springs, the barrier is the highest of the path's states, which need not be the exact summit.
    const double exactness = !drive.is_external() ? 0.01 : 1e-6;
    EXPECT_NEAR(found.barriers[0].energy, by_hinge.barriers[0].energy,
                exactness * by_hinge.barriers[0].energy);
    // A summit is flat, so theta is known to the square root of the relative error of the energy.
    EXPECT_NEAR(found.barriers[0].theta, by_hinge.barriers[0].theta, std::sqrt(exactness))
        << "of the sheet, whoever drives it";
    EXPECT_NEAR(found.states[1].energy, by_hinge.states[1].energy, 1e-6 * by_hinge.states[1].energy);
    EXPECT_LE(aligned_distance(s, found.states[1].state, by_hinge.states[1].state).rms, 1e-6);
  }
}

/// A twisting cell with soft springs snaps through during heating, and the path reports that.
TEST(ShapeMemory, SnapsThroughWhereItsSpringsAreSoft) {
  const Structure s = twisting_cell();
  Elasticity soft;
  soft.k_turn = 1e-3;
  const LinkageDrive drive = shape_memory_drive(s, {}, 20, -90 * radians_per_degree);
  const EquilibriumPath path = trace_equilibrium({s, drive, {}}, soft, without_contact());
  EXPECT_EQ(path.stop, Stop::reached) << path.why;
  EXPECT_NE(first_event(path, PathEvent::Kind::snap), nullptr);
  EXPECT_NEAR(mean_theta(s, path.state), -45 * radians_per_degree, 1 * radians_per_degree);
}

TEST(Cord, ThatNothingShortensIsRefused) {
  const Structure s = basic_sheet(3, 2);
  const auto hinge = [&](int i, int j, Axis axis) { return *s.hinge_at({{i, j}, axis}); };
  const std::vector<int> along = {hinge(0, 1, Axis::x), hinge(1, 1, Axis::x), hinge(2, 1, Axis::x)};
  EXPECT_THROW(cord_drive(s, along, 1), InvalidInput);
  EXPECT_NO_THROW(cord_drive(s, {along[0], along[2]}, 1));
  EXPECT_THROW(cord_drive(s, {along[0]}, 1), InvalidInput);
  EXPECT_THROW(cord_drive(s, {along[0], along[0], along[2]}, 1), InvalidInput);
  for (const double shorten : {-1.0, 20.0, 1e9, static_cast<double>(NAN)})
    EXPECT_THROW(cord_drive(s, {along[0], along[2]}, shorten), InvalidInput) << shorten;
  EXPECT_THROW(cord_drive(s, {along[0], along[2]}, 1, 0), InvalidInput);
}

TEST(ShapeMemory, OfNumbersOutOfRangeIsRefused) {
  const Structure s = basic_sheet(2, 2);
  for (const double k : {0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)})
    EXPECT_THROW(shape_memory_drive(s, {}, k, 0.5), InvalidInput) << k;
  for (const double angle : {pi, -pi, static_cast<double>(NAN)})
    EXPECT_THROW(shape_memory_drive(s, {}, 1, angle), InvalidInput) << angle;
  EXPECT_THROW(shape_memory_drive(s, {1, 2, 1}, 1, 0.5), InvalidInput);
}

/// Equilibrium under a drive that is rebuilt when the structure changes.
struct Held {
  Structure structure;
  Elasticity elasticity;
  std::function<LinkageDrive(const Structure&)> drive;
  double theta = 0;
  State state = {};
  double multiplier = 0, load = 0, energy = 0;
};

ElasticSystem system_of(const Held& b) {
  return ElasticSystem(b.structure, b.elasticity, b.drive(b.structure), false, false);
}

void settle(Held& b) {
  ElasticSystem system = system_of(b);
  system.set_multiplier(b.multiplier);
  TangentStiffness tangent(system.dofs());
  NewtonOptions options;
  options.force_tolerance = 0;
  options.drive_tolerance = 1e-15;
  const NewtonResult result = minimise(system, b.theta, options, b.state, tangent);
  ASSERT_TRUE(result.converged && result.stable);
  b.multiplier = system.multiplier();
  const double unit = energy_unit(b.elasticity, b.structure.size.edge_mm);
  b.load = system.load(b.state, b.theta) * unit / (system.drive().has_force() ? b.structure.size.edge_mm : 1);
  b.energy = system.stored_energy(b.state, b.theta) * unit;
}

Held changed(Held b, const VectorXd& q) {
  Eigen::Index k = 0;
  for (double HingeParameters::*field :
       {&HingeParameters::t, &HingeParameters::alpha, &HingeParameters::beta, &HingeParameters::offset})
    for (Hinge& hinge : b.structure.hinges) hinge.parameters.*field += q[k++];
  b.theta += q[k++];
  for (double Elasticity::*field : {&Elasticity::k_point, &Elasticity::k_turn, &Elasticity::reach_mm})
    b.elasticity.*field *= 1 + q[k++];
  settle(b);
  return b;
}

/// Returns one number that depends on all poses.
double weighted_sum(const Held& b, const State& state) {
  double sum = 0;
  for (std::size_t k = 0; k < state.size(); ++k) {
    const double w = 1 + std::sin(static_cast<double>(k));
    sum += w * state[k].p.dot(Eigen::Vector3d(0.3, -1, 0.7)) / b.structure.size.edge_mm;
    sum += w * (state[k].R * Eigen::Vector3d(0.5, 0.2, 0.1)).dot(Eigen::Vector3d(-0.4, 0.8, 1));
  }
  return sum;
}

VectorXd values(const Held& b) {
  VectorXd all(3);
  all << weighted_sum(b, b.state), b.load, b.energy;
  return all;
}

Eigen::RowVectorXd packed(const Held& b, const Sensitivity& s) {
  Eigen::RowVectorXd out(4 * static_cast<Eigen::Index>(b.structure.hinges.size()) + 4);
  out << s.hinges.row(0), s.hinges.row(1), s.hinges.row(2), s.hinges.row(3), s.theta,
      s.k_point * b.elasticity.k_point, s.k_turn * b.elasticity.k_turn, s.reach_mm * b.elasticity.reach_mm;
  return out;
}

/// Returns derivatives by the adjoint method, with the rows of values().
Eigen::MatrixXd by_adjoint(const Held& b, double* by_spring = nullptr) {
  ElasticSystem system = system_of(b);
  system.set_multiplier(b.multiplier);
  TangentStiffness tangent(system.dofs());
  system.linearise(b.state, b.theta, tangent);
  EXPECT_TRUE(tangent.factorise(0));
  const auto sum = [&](const VectorXd& x) {
    return VectorXd::Constant(1, weighted_sum(b, retract_straight(b.structure, b.state, x)));
  };
  const VectorXd by_state = numeric_jacobian(sum, zeros(b.state), 3e-3).transpose();
  const EquilibriumGradient gradients[] = {{by_state, 0, 0}, {{}, 1, 0}, {{}, 0, 1}};
  Eigen::MatrixXd out(3, 4 * static_cast<Eigen::Index>(b.structure.hinges.size()) + 4);
  for (int k = 0; k < 3; ++k) {
    const Sensitivity s = sensitivity(system, b.elasticity, b.state, b.theta, tangent, gradients[k]);
    out.row(k) = packed(b, s);
    if (by_spring) by_spring[k] = s.k_spring;
    if (k > 0) continue;
    const DesignSensitivity one = DesignSensitivities(system, b.state, b.theta, tangent).of(by_state);
    EXPECT_LE((one.hinges - s.hinges).norm(), 1e-12 * s.hinges.norm());
    EXPECT_NEAR(one.theta, s.theta, 1e-12 * std::abs(s.theta));
  }
  return out;
}

/// Returns a 3 x 2 panel in space, folded from flat.
Held folded(const std::function<LinkageDrive(const Structure&)>& drive, unsigned seed) {
  std::mt19937 random(seed);
  Structure s = random_panel(3, 2, random);
  for (std::size_t k = 0; k < s.hinges.size(); ++k) {
    s.hinges[k].parameters.t = 0.5 + (s.hinges[k].parameters.t - 0.5) / 2;
    s.hinges[k].parameters.offset = 0.05 * std::cos(static_cast<double>(k));
  }
  Held b{s, {1000, 20, 3, 3000}, drive};
  EquilibriumPathOptions options;
  options.planar = false;
  options.contact = false;
  const EquilibriumPath path = trace_equilibrium({s, drive(s), {}}, b.elasticity, options);
  EXPECT_EQ(path.stop, Stop::reached) << path.why;
  b.theta = path.theta;
  b.state = path.state;
  b.multiplier = path.multiplier;
  settle(b);
  return b;
}

void expect_adjoint(const Held& b) {
  const auto hinges = static_cast<Eigen::Index>(b.structure.hinges.size());
  const VectorXd zero = VectorXd::Zero(4 * hinges + 4);
  const Eigen::MatrixXd numeric =
      numeric_jacobian([&](const VectorXd& q) { return values(changed(b, q)); }, zero, 1e-3);
  EXPECT_LE(
      relative_difference_by_groups(by_adjoint(b), numeric, {hinges, hinges, hinges, hinges, 1, 1, 1, 1}),
      1e-6);
}

TEST(CordAdjoint, IsTheCentralDifferenceOfEquilibriaFoundAnew) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    expect_adjoint(folded([](const Structure& s) { return cord_drive(s, across_row(s, 0, 3), 3); }, seed));
  }
}

TEST(ShapeMemoryAdjoint, IsTheCentralDifferenceOfEquilibriaFoundAnew) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    const auto with = [](double k) {
      return [k](const Structure& s) { return shape_memory_drive(s, {}, k, 40 * radians_per_degree); };
    };
    const Held b = folded(with(50), seed);
    expect_adjoint(b);
    double by_spring[3] = {};
    by_adjoint(b, by_spring);
    const auto by_k = [&](const VectorXd& k) {
      Held at = b;
      at.drive = with(k[0]);
      settle(at);
      return values(at);
    };
    const VectorXd numeric = numeric_jacobian(by_k, VectorXd::Constant(1, 50), 0.1).col(0);
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(by_spring[k], numeric[k], 1e-6 * std::abs(numeric[k]) + 1e-9) << k;
  }
}

}  // namespace
}  // namespace kinetix::model
