#include "benchmarks/speed_error/bullet_points.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <limits>

#include "benchmarks/speed_error/timed.hpp"
#include "benchmarks/stopwatch.hpp"
#include "sim/physics_run.hpp"

namespace kinetix::bench {
namespace {

// Sizes of scenes between which the time budgets of rigid_grid change.
constexpr std::size_t few_bodies = 100, many_bodies = 2000;
// Steps of a whole drive: from fewer than give an answer to more than budgets allow.
constexpr int drive_steps[] = {5, 10, 15, 20, 30, 40, 60, 80, 120, 240, 500, 1000, 2000};
constexpr double longest_step_s = 0.1;  // s, the most that PhysicsOptions::step_s allows
constexpr double stiff_joints = 1e8;    // over the parts' masses, as app/pipeline/physics.cpp has it for nets

/// All numbers of steps with joints of one stiffness.
struct GridLine {
  double joint_stiffness;
  double budget_s;            ///< for all its runs together
  std::vector<double> rests;  ///< hinge speeds at which a run ends, rad/s, from loose to tight
};

std::vector<GridLine> rigid_grid(std::size_t bodies) {
  const std::vector<double> rests = {1e-1, 1e-2, 1e-3, 1e-4, sim::PhysicsOptions{}.settle_speed};
  const bool few = bodies<few_bodies, many = bodies> many_bodies;
  const double budget = many ? 12 : few ? 6 : 3;
  std::vector<GridLine> lines;
  for (const double stiffness : {sim::PhysicsOptions{}.joint_stiffness, stiff_joints})
    lines.push_back({stiffness, budget, rests});
  return lines;
}

/// Returns the grid for elastic hinges: their stiffnesses are given, and a run ends by the equilibrium of forces.
std::vector<GridLine> elastic_grid() { return {{0, 10, {0}}}; }

// Name of the series in plot and table (series_style.cpp), and how a run ended.
const std::string bullet = "Bullet, direct";
const std::string at_rest = to_string(sim::PhysicsResult::Status::settled);
const std::string at_rest_but_open = "settled with open hinges";

/// Failures are judged by the error alone: no run ends early for a gap that the next steps may close.
sim::PhysicsOptions options_of(const SpeedErrorScene& scene, const GridLine& line, int steps, double rest) {
  sim::PhysicsOptions options;
  options.step_s = std::min(longest_step_s, options.drive_seconds / steps);
  options.drive_seconds = steps * options.step_s;
  if (scene.is_exact()) {
    options.joint_stiffness = line.joint_stiffness;
    options.settle_speed = rest;
    options.gap_limit = options.tear_limit = options.overlap_limit = 1;
  } else {
    options.elastic = relative(scene.elasticity, scene.structure.size.edge_mm);
    options.planar = all_vertical(scene.structure);
  }
  return options;
}

std::string words(const SpeedErrorScene& scene, const GridLine& line, int steps, double rest) {
  const std::string count = fmt::format("{} steps", steps);
  if (!scene.is_exact()) return count;
  return fmt::format("{}, joints {:.0e}, rest {:.0e}", count, line.joint_stiffness, rest);
}

void set_outcome(const SpeedErrorScene& scene, const sim::PhysicsResult& run, MeasuredPoint& point) {
  const double most_open = sim::PhysicsOptions{}.gap_limit;
  const bool is_open = scene.is_exact() && !(std::max(run.gaps.max, run.drive_gap) <= most_open);
  point.status = to_string(run.status);
  if (point.status == at_rest && is_open) point.status = at_rest_but_open;
  point.is_result = point.status == at_rest;
  point.error = is_finite(run.state) ? aligned_distance(scene.structure, run.state, scene.reference).rms
                                     : std::numeric_limits<double>::quiet_NaN();
}

MeasuredPoint measured(const SpeedErrorScene& scene, const GridLine& line, int steps, double rest) {
  MeasuredPoint point{
      .method = bullet, .settings = words(scene, line, steps, rest), .precision = KINETIX_BULLET_PRECISION};
  const sim::PhysicsOptions options = options_of(scene, line, steps, rest);
  sim::PhysicsResult run;
  const auto timed_run = [&] {
    run = run_compression(scene.structure, drive_on(scene.structure, scene.drive), options);
    return run.seconds;
  };
  time_runs(timed_run, point);
  set_outcome(scene, run, point);
  return point;
}

/// Measures one number of steps for several thresholds of rest. Once a run does not settle, stricter thresholds change
/// nothing.
void add_points(const SpeedErrorScene& scene, const GridLine& line, int steps, MeasuredPoints& points) {
  for (const double rest : line.rests) {
    points.push_back(measured(scene, line, steps, rest));
    if (points.back().status != at_rest && points.back().status != at_rest_but_open) return;
  }
}

/// Adds points from few steps to many, until the next runs would exceed the budget of the line.
void add_line(const SpeedErrorScene& scene, const GridLine& line, MeasuredPoints& points) {
  double spent = 0, a_step = 0;
  for (const int steps : drive_steps) {
    if (spent + steps * a_step > line.budget_s) return;
    const double time = seconds([&] { add_points(scene, line, steps, points); });
    spent += time;
    a_step = time / steps;
  }
}

}  // namespace

MeasuredPoints bullet_points(const SpeedErrorScene& scene) {
  MeasuredPoints points;
  for (const GridLine& line : scene.is_exact() ? rigid_grid(scene.structure.bodies.size()) : elastic_grid())
    add_line(scene, line, points);
  return points;
}

}  // namespace kinetix::bench
