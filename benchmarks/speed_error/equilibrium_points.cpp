#include "benchmarks/speed_error/equilibrium_points.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "benchmarks/speed_error/timed.hpp"
#include "benchmarks/stopwatch.hpp"

namespace kinetix::bench {
namespace {

constexpr double longest_run_s = 10;  // s: later settings are stricter, and would hold up the figure

struct Setting {
  std::string words;
  model::Elasticity elasticity;
  model::EquilibriumPathOptions options;
};

model::EquilibriumPathOptions in_steps_of(double step) {
  model::EquilibriumPathOptions options;
  options.first_step = std::min(options.first_step, step);
  options.longest_step = step;
  options.longest_step_touching = std::min(options.longest_step_touching, step);
  return options;
}

/// A Newton step shorter than `length` ends the search, whatever force is left.
model::EquilibriumPathOptions to_tolerance(model::EquilibriumPathOptions options, double length) {
  options.newton.step_tolerance = length;
  options.newton.force_tolerance = std::max(options.newton.force_tolerance, 1e-2 * length);
  return options;
}

std::vector<Setting> over_stiffness(const SpeedErrorScene& scene) {
  std::vector<Setting> settings;
  for (const double ratio : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-10, 1e-12}) {
    model::Elasticity elasticity;
    elasticity.k_turn = ratio * energy_unit(elasticity, scene.structure.size.edge_mm);
    settings.push_back({fmt::format("stiffness ratio {:.0e}", ratio), elasticity, {}});
  }
  return settings;
}

std::vector<Setting> over_tolerance(const SpeedErrorScene& scene) {
  std::vector<Setting> settings;
  for (const double step : {0.12, 0.04, 0.01})
    for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-6, 1e-11})
      settings.push_back({fmt::format("steps of {} rad, Newton to {:.0e}", step, tolerance), scene.elasticity,
                          to_tolerance(in_steps_of(step), tolerance)});
  return settings;
}

MeasuredPoint measured(const SpeedErrorScene& scene, const Setting& setting) {
  MeasuredPoint point{.method = "equilibrium", .settings = setting.words, .precision = "double"};
  model::EquilibriumPath path;
  const auto follow = [&] {
    path = trace_equilibrium(driven(scene.structure, scene.drive), setting.elasticity, setting.options);
  };
  time_runs([&] { return seconds(follow); }, point);
  point.is_result = path.stop == model::EquilibriumPath::Stop::reached;
  point.error = aligned_distance(scene.structure, path.state, scene.reference).rms;
  point.status = to_string(path.stop);
  return point;
}

model::EquilibriumPath fine_path(const SpeedErrorScene& scene, double step) {
  const model::EquilibriumPath path =
      trace_equilibrium(driven(scene.structure, scene.drive), scene.elasticity, in_steps_of(step));
  if (path.stop != model::EquilibriumPath::Stop::reached)
    throw std::runtime_error(scene.name + ": " + path.why);
  return path;
}

}  // namespace

MeasuredPoints equilibrium_points(const SpeedErrorScene& scene) {
  MeasuredPoints points;
  for (const Setting& setting : scene.is_exact() ? over_stiffness(scene) : over_tolerance(scene)) {
    points.push_back(measured(scene, setting));
    if (points.back().seconds > longest_run_s) break;
  }
  return points;
}

void set_finest_equilibrium(SpeedErrorScene& scene) {
  constexpr double finest_step = 2.5e-3;
  scene.reference = fine_path(scene, finest_step).state;
  scene.reference_error =
      aligned_distance(scene.structure, fine_path(scene, 2 * finest_step).state, scene.reference).rms;
}

}  // namespace kinetix::bench
