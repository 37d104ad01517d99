#include "benchmarks/speed_error/bullet_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "benchmarks/speed_error/timed.hpp"
#include "benchmarks/stopwatch.hpp"
#include "sim/compression_run.hpp"

namespace kinetix::bench {
namespace {

using Solver = PhysicsOptions::Solver;

constexpr std::size_t many_bodies = 2000;
constexpr int steps_a_second[] = {10, 15, 20, 30, 40, 60, 80, 120, 240, 500, 1000, 2000};

bool is_large(const SpeedErrorScene& scene) { return scene.structure.bodies.size() > many_bodies; }

/// Seconds for all time steps of one solver.
double line_budget(const SpeedErrorScene& scene, Solver solver) {
  return is_large(scene) && solver == Solver::direct ? 20 : 5;
}

/// Hinge speeds at which a run ends, rad/s, from loose to tight. Elastic runs end by balance of forces.
std::vector<double> rests_of(const SpeedErrorScene& scene, Solver solver) {
  if (!scene.is_exact()) return {0};
  if (solver == Solver::sweeps) return {1e-2, 1e-8};
  if (is_large(scene)) return {1e-3, 1e-8};
  return {1e-1, 1e-2, 1e-3, 1e-4, 1e-8};
}

const std::string at_rest = to_string(PhysicsResult::Status::settled);
const std::string at_rest_but_open = "settled with open hinges";

struct Setting {
  Solver solver;
  int iterations;
  int steps_a_second;
  double rest;
};

/// Failures are judged by the error alone: no run ends early for a gap that the next steps may close.
PhysicsOptions options_of(const SpeedErrorScene& scene, const Setting& setting) {
  PhysicsOptions options;
  options.solver = setting.solver;
  options.iterations = setting.iterations;
  options.step_s = 1.0 / setting.steps_a_second;
  if (scene.is_exact()) {
    options.settle_speed = setting.rest;
    options.gap_limit = options.tear_limit = options.overlap_limit = 1;
    if (scene.family.family == Family::F4) options.joint_stiffness = 1e8;
  } else {
    options.elastic = relative(scene.elasticity, scene.structure.size.edge_mm);
    options.planar = all_vertical(scene.structure);
  }
  return options;
}

std::string words(const SpeedErrorScene& scene, const Setting& setting) {
  std::string text = fmt::format("1/{} s", setting.steps_a_second);
  if (setting.solver == Solver::sweeps) text += fmt::format(", {} sweeps", setting.iterations);
  if (!scene.is_exact()) return text + fmt::format(", {} sweeps over contacts", setting.iterations);
  return text + fmt::format(", rest {:.0e}", setting.rest);
}

void set_outcome(const SpeedErrorScene& scene, const PhysicsResult& run, MeasuredPoint& point) {
  const double most_open = PhysicsOptions{}.gap_limit;
  const bool is_open = scene.is_exact() && !(std::max(run.gaps.max, run.drive_gap) <= most_open);
  point.status = to_string(run.status);
  if (point.status == at_rest && is_open) point.status = at_rest_but_open;
  point.is_result = point.status == at_rest;
  point.error = is_finite(run.state) ? aligned_distance(scene.structure, run.state, scene.reference).rms
                                     : std::numeric_limits<double>::quiet_NaN();
}

MeasuredPoint measured(const SpeedErrorScene& scene, const Setting& setting) {
  MeasuredPoint point{.method = setting.solver == Solver::direct ? "Bullet, direct" : "Bullet, sweeps",
                      .settings = words(scene, setting),
                      .precision = KINETIX_BULLET_PRECISION};
  const PhysicsOptions options = options_of(scene, setting);
  PhysicsResult run;
  const auto timed_run = [&] {
    run = run_compression(scene.structure, scene.drive, options);
    return run.seconds;
  };
  time_runs(timed_run, point);
  set_outcome(scene, run, point);
  return point;
}

/// One time step, over how near to rest the run ends: once it does not come to rest, the rest is the same.
void add_points(const SpeedErrorScene& scene, Setting setting, MeasuredPoints& points) {
  for (const double rest : rests_of(scene, setting.solver)) {
    setting.rest = rest;
    points.push_back(measured(scene, setting));
    if (points.back().status != at_rest && points.back().status != at_rest_but_open) return;
  }
}

/// All time steps, from long to short, until the next would take the whole line past its budget.
void add_line(const SpeedErrorScene& scene, Solver solver, int iterations, MeasuredPoints& points) {
  double spent = 0, a_step = 0;
  for (const int steps : steps_a_second) {
    if (spent + steps * a_step > line_budget(scene, solver)) return;
    const double time = seconds([&] { add_points(scene, {solver, iterations, steps, 0}, points); });
    spent += time;
    a_step = time / steps;
  }
}

}  // namespace

MeasuredPoints bullet_points(const SpeedErrorScene& scene) {
  MeasuredPoints points;
  if (scene.is_exact()) add_line(scene, Solver::direct, PhysicsOptions{}.iterations, points);
  for (const int iterations : {10, 50, 200})
    if (scene.is_exact()) add_line(scene, Solver::sweeps, iterations, points);
  for (const int iterations : {10, 200})
    if (!scene.is_exact()) add_line(scene, Solver::direct, iterations, points);
  return points;
}

}  // namespace kinetix::bench
