#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <random>

#include "model/base/geometry.hpp"
#include "model/lattice/square/structure.hpp"
#include "model/material/process.hpp"
#include "model/tolerance/print_tolerance.hpp"
#include "tests/support/elastic_equilibrium.hpp"

namespace kinetix::model {
namespace {

using namespace testing;
using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::hinge_drive;

ToleranceResult of_equilibrium(const Equilibrium& b, const std::vector<ObservedPoint>& points,
                               const HingeScatter& scatter, const ToleranceOptions& options = {}) {
  ElasticSystem system(b.structure, b.elasticity, drive_on(b.structure, b.drive), b.planar, true);
  system.set_multiplier(b.multiplier);
  TangentStiffness tangent(system.dofs());
  system.linearise(b.state, b.theta, tangent);
  EXPECT_TRUE(tangent.factorise(0));
  return analyse_print_tolerance(system, b.state, b.theta, tangent, points, scatter, options);
}

/// Returns a bent sheet with its first wall turned.
Equilibrium bent(int columns, int rows) {
  Structure s = make_structure(rectangle(columns, rows), {10, 0.8, 6});
  for (Hinge& hinge : s.hinges)
    if (hinge.wall.axis == Axis::x)
      hinge.parameters.beta =
          (starts_in_sublattice_b(hinge.wall) ? -0.2 : 0.2) * (1 + 0.1 * hinge.wall.from.i);
  Equilibrium b = equilibrium(s, {}, hinge_drive(s, {{0, 0}, Axis::y}, 0.35), false);
  EXPECT_TRUE(b.found);
  return b;
}

/// Returns every body as an observed point, each seen along another direction.
std::vector<ObservedPoint> every_body(const Equilibrium& b, double miss_mm) {
  std::vector<ObservedPoint> points;
  for (int k = 0; k < static_cast<int>(b.state.size()); ++k)
    points.push_back(
        {{k}, b.state[k].p, Vector3d(std::sin(k), 0.3, std::cos(k)).normalized(), miss_mm * std::sin(5 * k)});
  return points;
}

/// Returns the change of all hinges in one print, as changed() takes it.
VectorXd printed(const Equilibrium& b, const HingeScatter& scatter, std::mt19937& random) {
  std::normal_distribution<double> normal(0, 1);
  VectorXd q = VectorXd::Zero(parameter_count(b));
  const auto hinges = static_cast<Eigen::Index>(b.structure.hinges.size());
  for (int part = 0; part < 4; ++part)
    for (Eigen::Index h = 0; h < hinges; ++h) q[part * hinges + h] = scatter.values()[part] * normal(random);
  return q;
}

/// Returns the rms distance of a state's points from those of the design, after the best small rigid motion.
double distance(const std::vector<ObservedPoint>& points, const State& state, bool aligned) {
  const auto count = static_cast<Eigen::Index>(points.size());
  VectorXd miss(count);
  Eigen::MatrixXd rigid(count, 6);
  for (Eigen::Index k = 0; k < count; ++k) {
    const ObservedPoint& p = points[k];
    miss[k] = p.miss_mm + p.normal.dot(state[p.bodies[0]].p - p.place);
    rigid.row(k) << p.normal.transpose(), p.place.cross(p.normal).transpose();
  }
  VectorXd designed(count);
  for (Eigen::Index k = 0; k < count; ++k) designed[k] = points[k].miss_mm;
  VectorXd moved = miss - designed;
  if (aligned) moved -= rigid * rigid.completeOrthogonalDecomposition().solve(moved);
  return (designed + moved).norm() / std::sqrt(static_cast<double>(count));
}

/// Returns the states of prints whose hinges are off by their scatter, each in equilibrium again.
std::vector<State> printed_states(const Equilibrium& b, const HingeScatter& scatter, int prints,
                                  unsigned seed) {
  std::mt19937 random(seed);
  std::vector<State> states;
  for (int k = 0; k < prints; ++k) {
    const Equilibrium print = changed(b, printed(b, scatter, random));
    EXPECT_TRUE(print.found);
    states.push_back(print.state);
  }
  return states;
}

TEST(ToleranceResult, IsWhatManyPrintsComeTo) {
  const Equilibrium b = bent(4, 3);
  const HingeScatter scatter{0.004, 0.003, 0.004, 0.002};
  constexpr int prints = 1000;  // the mean of squares is then known to about 3 %
  const std::vector<State> states = printed_states(b, scatter, prints, 11);
  for (const bool aligned : {true, false}) {
    const std::vector<ObservedPoint> points = every_body(b, aligned ? 0.02 : 0.0);
    ToleranceOptions options;
    options.aligned = aligned;
    const ToleranceResult made = of_equilibrium(b, points, scatter, options);
    std::vector<double> distances;
    double squares = 0;
    for (const State& state : states) {
      distances.push_back(distance(points, state, aligned));
      squares += distances.back() * distances.back() / prints;
    }
    std::sort(distances.begin(), distances.end());
    EXPECT_NEAR(made.rms_mm, std::sqrt(squares), 0.04 * made.rms_mm) << aligned;
    EXPECT_NEAR(made.p95_mm, distances[prints * 95 / 100], 0.06 * made.p95_mm) << aligned;
    EXPECT_GT(made.rms_mm, 1.2 * made.designed_mm) << "the errors count";
  }
}

// Pins rest uniformly in bores of scattered clearance and lean uniformly in them: each hinge is not normally
// distributed.
TEST(ToleranceResult, CountsPlayAsManyLoosePrintsDo) {
  const Equilibrium b = bent(4, 3);
  const double edge_mm = b.structure.size.edge_mm, sd_mm = 0.03;
  ManufacturedHinge pin{.kind = HingeKind::pin,
                        .height_mm = b.structure.size.height_mm,
                        .diameter_mm = 1,
                        .clearance_mm = 0.05};
  const ClearanceScatter play = clearance_scatter(pin, {0, 0, sd_mm});
  const std::vector<ObservedPoint> points = every_body(b, 0.02);
  const ToleranceResult made =
      of_equilibrium(b, points, {play.place_mm / edge_mm, 0, play.tilt, play.place_mm / edge_mm});
  std::mt19937 random(5);
  std::normal_distribution<double> clearance(pin.clearance_mm, sd_mm);
  std::uniform_real_distribution<double> even(-1, 1);
  const auto hinges = static_cast<Eigen::Index>(b.structure.hinges.size());
  constexpr int prints = 600;  // the mean of squares is then known to about 4 %
  double squares = 0;
  for (int k = 0; k < prints; ++k) {
    VectorXd q = VectorXd::Zero(parameter_count(b));
    for (Eigen::Index h = 0; h < hinges; ++h) {
      pin.clearance_mm = clearance(random);
      q[h] = pin.clearance_mm / edge_mm * even(random);
      q[2 * hinges + h] = clearance_tilt(pin) * even(random);
      q[3 * hinges + h] = pin.clearance_mm / edge_mm * even(random);
    }
    const Equilibrium print = changed(b, q);
    ASSERT_TRUE(print.found);
    const double off = distance(points, print.state, true);
    squares += off * off / prints;
  }
  EXPECT_NEAR(made.rms_mm, std::sqrt(squares), 0.05 * made.rms_mm);
  EXPECT_GT(made.rms_mm, 1.5 * made.designed_mm) << "play counts";
}

// A point that is seen in three directions square to each other is one point: its distance is that in space.
TEST(ToleranceResult, CountsPointsAndNotTheirDirections) {
  const Equilibrium b = bent(4, 3);
  const HingeScatter scatter{0.004, 0.003, 0.004, 0.002};
  constexpr int prints = 400;  // the mean of squares is then known to about 5 %
  const std::vector<State> states = printed_states(b, scatter, prints, 3);
  for (int directions = 1; directions <= 3; ++directions) {
    const Eigen::Matrix3d axes = rotation_of(Vector3d(0.3, 0.5, -0.4));
    std::vector<ObservedPoint> points;
    for (int k = 0; k < static_cast<int>(b.state.size()); ++k)
      for (int d = 0; d < directions; ++d)
        points.push_back({{k}, b.state[k].p, axes.col(d), 0.01 * (d + 1), directions});
    ToleranceOptions options;
    options.aligned = false;
    const ToleranceResult made = of_equilibrium(b, points, scatter, options);
    EXPECT_NEAR(made.designed_mm,
                0.01 * std::sqrt(directions * (directions + 1) * (2 * directions + 1) / 6.0), 1e-12);
    double squares = 0;
    for (const State& state : states)
      for (std::size_t body = 0; body < state.size(); ++body) {
        Vector3d off = axes.transpose() * (state[body].p - b.state[body].p) + 0.01 * Vector3d(1, 2, 3);
        off.tail(3 - directions).setZero();
        squares += off.squaredNorm() / static_cast<double>(prints * state.size());
      }
    EXPECT_NEAR(made.rms_mm, std::sqrt(squares), 0.06 * made.rms_mm) << directions;
  }
}

// Both are derivatives of one state: of a function of it by all errors, and of the state along some errors.
TEST(ToleranceResult, ChangesOfTheStateAgreeWithTheAdjoint) {
  for (const bool planar : {false, true})
    for (const bool plates : {false, true}) {
      const Equilibrium b = random_equilibrium({5, planar, plates, false});
      ElasticSystem system(b.structure, b.elasticity, drive_on(b.structure, b.drive), planar, true);
      system.set_multiplier(b.multiplier);
      TangentStiffness tangent(system.dofs());
      system.linearise(b.state, b.theta, tangent);
      ASSERT_TRUE(tangent.factorise(0));
      const DesignSensitivities by_design(system, b.state, b.theta, tangent);
      const Eigen::Matrix4Xd errors = Eigen::Matrix4Xd::Random(4, b.structure.hinges.size());
      VectorXd change = by_design.change(errors);
      for (Eigen::Index k = 0; k < change.size(); k += 5) {
        const DesignSensitivity of = by_design.of(VectorXd::Unit(change.size(), k));
        EXPECT_NEAR(change[k], of.hinges.cwiseProduct(errors).sum(), 1e-6 * change.norm())
            << planar << plates << k;
      }
    }
}

TEST(ToleranceResult, MixturesStandForAllPoints) {
  const Equilibrium b = bent(4, 3);
  const std::vector<ObservedPoint> points = every_body(b, 0.1);
  const HingeScatter scatter{0.004, 0, 0.004, 0};
  ToleranceOptions few;
  few.probes = static_cast<int>(points.size()) - 1;
  const ToleranceResult each = of_equilibrium(b, points, scatter),
                        mixed = of_equilibrium(b, points, scatter, few);
  EXPECT_EQ(mixed.designed_mm, each.designed_mm);
  EXPECT_NEAR(mixed.rms_mm, each.rms_mm, 0.25 * each.rms_mm) << "19 mixtures only";
  double shares = 0;
  for (const ScatterSource& source : mixed.sources) shares += source.share;
  EXPECT_NEAR(shares, 1, 1e-12);
}

TEST(ToleranceResult, NamesWhatCountsMost) {
  const Equilibrium b = bent(3, 2);
  const std::vector<ObservedPoint> points = every_body(b, 0);
  const ToleranceResult made = of_equilibrium(b, points, {0, 0, 0.01, 0});
  ASSERT_EQ(made.sources.size(), b.structure.hinges.size());
  // Each tilt by itself, by differences.
  const auto hinges = static_cast<Eigen::Index>(b.structure.hinges.size());
  VectorXd squares(hinges);
  for (Eigen::Index h = 0; h < hinges; ++h) {
    VectorXd q = VectorXd::Zero(parameter_count(b));
    q[2 * hinges + h] = 1e-5;
    const double up = distance(points, changed(b, q).state, true);
    squares[h] = up * up;
  }
  for (std::size_t k = 0; k < made.sources.size(); ++k) {
    EXPECT_EQ(made.sources[k].parameter, 2);
    EXPECT_NEAR(made.sources[k].share, squares[made.sources[k].hinge] / squares.sum(), 1e-3);
    EXPECT_LE(made.sources[k].share, made.sources[k > 0 ? k - 1 : 0].share);
  }
}

TEST(ToleranceResult, HingesOfTheirOwnScatterByTheirOwnErrors) {
  const Equilibrium b = bent(3, 2);
  const std::vector<ObservedPoint> points = every_body(b, 0);
  const HingeScatter some{0.004, 0, 0.006, 0};
  HingeScatter alike = some, half = some;
  alike.each.assign(b.structure.hinges.size(), some);
  for (std::size_t h = 0; h < b.structure.hinges.size(); ++h)
    half.each.push_back(h % 2 == 0 ? some : HingeScatter{});
  half.t = 1;  // not used
  const ToleranceResult one = of_equilibrium(b, points, some), each = of_equilibrium(b, points, alike),
                        every_other = of_equilibrium(b, points, half);
  EXPECT_EQ(each.rms_mm, one.rms_mm);
  EXPECT_LT(every_other.rms_mm, one.rms_mm);
  EXPECT_EQ(every_other.sources.size(), b.structure.hinges.size() + b.structure.hinges.size() % 2);
  for (const ScatterSource& source : every_other.sources) EXPECT_EQ(source.hinge % 2, 0);
  const Eigen::Matrix4Xd spread = half.by_hinge(static_cast<Eigen::Index>(b.structure.hinges.size()));
  EXPECT_EQ(spread.col(0), some.values());
  EXPECT_EQ(spread.col(1), Eigen::Vector4d::Zero());
}

TEST(ToleranceResult, OfExactPrintsIsTheDesign) {
  const Equilibrium b = bent(2, 2);
  const ToleranceResult made = of_equilibrium(b, every_body(b, 0.2), {});
  EXPECT_EQ(made.rms_mm, made.designed_mm);
  EXPECT_EQ(made.p95_mm, made.designed_mm);
  EXPECT_TRUE(made.sources.empty());
  EXPECT_GT(made.designed_mm, 0.05);
}

}  // namespace
}  // namespace kinetix::model
