#include "benchmarks/speed_error/bullet_points.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "benchmarks/speed_error/timed.hpp"
#include "sim/compression_run.hpp"

namespace kinetix::bench {
namespace {

using Solver = PhysicsOptions::Solver;

constexpr double longest_run_s = 3;
constexpr int steps_a_second[] = {10, 15, 20, 30, 40, 60, 80, 120, 240, 500, 1000, 2000};

/// Hinge speeds at which a run ends, rad/s, from loose to tight. Elastic runs end by balance of forces.
constexpr double rests[] = {1e-1, 1e-2, 1e-3, 1e-4, 1e-8};

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
    options.gap_limit = options.tear_limit = 1;
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
  return text + fmt::format(", rest {:.0e} rad/s", setting.rest);
}

MeasuredPoint measured(const SpeedErrorScene& scene, const Setting& setting) {
  const PhysicsOptions options = options_of(scene, setting);
  PhysicsResult run;
  MeasuredPoint point{.method = setting.solver == Solver::direct ? "Bullet, direct" : "Bullet, sweeps",
                      .settings = words(scene, setting),
                      .precision = KINETIX_BULLET_PRECISION};
  time_runs(
      [&] {
        run = run_compression(scene.structure, scene.drive, options);
        return run.seconds;
      },
      point);
  const double most_open = PhysicsOptions{}.gap_limit;
  const bool is_open = scene.is_exact() && !(std::max(run.gaps.max, run.drive_gap) <= most_open);
  point.status = run.status == PhysicsResult::Status::settled && is_open ? "hinges open" : to_string(run.status);
  point.is_result = run.status == PhysicsResult::Status::settled && !is_open;
  point.error = is_finite(run.state) ? aligned_distance(scene.structure, run.state, scene.reference).rms
                                     : std::numeric_limits<double>::quiet_NaN();
  return point;
}

/// One time step, over how near to rest the run ends: once it does not come to rest, the rest is the same.
/// @return seconds of the longest run
double add_points(const SpeedErrorScene& scene, Setting setting, MeasuredPoints& points) {
  double longest = 0;
  for (const double rest : rests) {
    setting.rest = rest;
    points.push_back(measured(scene, setting));
    longest = std::max(longest, points.back().seconds);
    if (!scene.is_exact() || points.back().status == to_string(PhysicsResult::Status::not_settled)) break;
  }
  return longest;
}

/// All time steps, from long to short, as far as time allows.
void add_line(const SpeedErrorScene& scene, Solver solver, int iterations, MeasuredPoints& points) {
  double seconds_a_step = 0;
  for (const int steps : steps_a_second) {
    if (steps * seconds_a_step > longest_run_s) break;
    seconds_a_step = add_points(scene, {solver, iterations, steps, 0}, points) / steps;
  }
}

}  // namespace

MeasuredPoints bullet_points(const SpeedErrorScene& scene) {
  MeasuredPoints points;
  if (scene.is_exact()) add_line(scene, Solver::direct, PhysicsOptions{}.iterations, points);
  for (const int iterations : {10, 50, 200})
    add_line(scene, scene.is_exact() ? Solver::sweeps : Solver::direct, iterations, points);
  return points;
}

}  // namespace kinetix::bench
