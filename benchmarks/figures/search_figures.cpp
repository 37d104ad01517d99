#include <fmt/format.h>

#include "benchmarks/figure.hpp"
#include "benchmarks/scenes.hpp"
#include "benchmarks/stopwatch.hpp"
#include "optim/curve/fit_curve.hpp"

namespace kinetix::bench {
namespace {

Figure exact_curves() {
  std::mt19937 random(4);
  double worst = 0;
  int curves = 0;
  for (int columns = 6; columns <= 40; ++columns)
    for (int made = 0; made < 6;) {
      const auto goal = testing::reachable_curve(columns, 8, random);
      if (!goal) continue;
      optim::CurveVariables variables;
      variables.columns = columns;
      worst = std::max(worst, fit_curve(*goal, variables, {}).error.rms);
      ++made;
      ++curves;
    }
  return {fmt::format(
              "{} curves that some design reaches exactly (random tilts to 40 deg, 6 to 40 columns): worst "
              "shape_rms",
              curves),
          "<= 1e-6", fmt::format("{:.1e}", worst), worst <= 1e-6};
}

Figure shape_error(const Scene& scene) {
  const double limits[] = {3e-3, 9e-4, 3e-4, 8e-5};
  std::string measured;
  bool met = true;
  for (int k = 0; k < 4; ++k) {
    const double rms = fit_curve(scene.goal, strip(scene, 10 << k), {}).error.rms;
    measured += fmt::format("{}{:.2e}", k ? ", " : "", rms);
    met = met && rms <= limits[k];
  }
  return {scene.name + ", 10, 20, 40, 80 columns: shape_rms", "<= 3e-3, 9e-4, 3e-4, 8e-5", measured, met};
}

optim::MultiStartOptions on_one_core(optim::SolverName name) {
  optim::MultiStartOptions options;
  options.threads = 1;
  options.solver.name = name;
  return options;
}

Figure fit_time(const Scene& scene) {
  const optim::CurveVariables variables = strip(scene, 40);
  const double t = median_seconds(11, 1, [&] {
    fit_free_curve(scene.goal, variables,
                   {variables.cell_mm, 0.1 * variables.cell_mm, 0.6 * variables.cell_mm},
                   on_one_core(optim::SolverName::ceres));
  });
  return {scene.name + ", 40 columns, all 8 starts, the error and the free walls, one core", "<= 100 ms",
          fmt::format("{:.1f} ms", 1e3 * t), t <= 0.1};
}

/// Times both searches from the same starts. Each derivative-free one stops within 1 % of the error that Ceres reached
/// from the same start, or at its evaluation limit.
Figure derivative_free_ratio(const Scene& scene, optim::SolverName name) {
  const optim::CurveVariables v = strip(scene, 40);
  const optim::CurveFit fit(scene.goal, make_bend_ties(v.columns, v.per, v.symmetry, v.beta), v.cell_mm,
                            v.theta);
  const optim::MultiStartOptions options = on_one_core(optim::SolverName::ceres);
  double ceres_time = 0, other_time = 0;
  int reached = 0;
  for (int k = 0; k < options.starts; ++k) {
    const Eigen::VectorXd start = curve_start(fit, k, options.seed);
    optim::SolveResult best;
    ceres_time += median_seconds(5, 1, [&] { best = solve(fit, start, options.solver); });
    optim::SolverOptions other = options.solver;
    other.name = name;
    other.target = 1.01 * best.residual_norm;
    other.tolerance = 1e-14;
    other.max_evaluations = 20000;
    optim::SolveResult slow;
    other_time += seconds([&] { slow = solve(fit, start, other); });
    if (slow.status == optim::SolveStatus::target_reached) ++reached;
  }
  const double ratio = other_time / ceres_time;
  return {fmt::format("{}, 40 columns: Ceres against {}, same 8 starts, to the same error", scene.name,
                      description(name)),
          ">= 100 times faster",
          fmt::format("{}{:.0f} times ({:.1f} ms against {:.0f} ms; {} reached it in {} of 8 starts)",
                      reached == options.starts ? "" : "at least ", ratio, 1e3 * ceres_time, 1e3 * other_time,
                      to_string(name), reached),
          ratio >= 100};
}

}  // namespace

std::vector<Figure> search_figures() {
  std::vector<Figure> figures = {exact_curves()};
  const std::vector<Scene> scenes = regression_scenes();
  for (const Scene& scene : scenes) figures.push_back(shape_error(scene));
  for (const Scene& scene : scenes) figures.push_back(fit_time(scene));
  for (const Scene& scene : scenes)
    figures.push_back(derivative_free_ratio(scene, optim::SolverName::bobyqa));
  figures.push_back(derivative_free_ratio(scenes[1], optim::SolverName::cobyla));
  return figures;
}

}  // namespace kinetix::bench
