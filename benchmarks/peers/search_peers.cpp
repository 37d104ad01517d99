#include <fmt/format.h>

#include "benchmarks/figure.hpp"
#include "benchmarks/peers/differenced_problem.hpp"
#include "benchmarks/peers/simulated_fit.hpp"
#include "benchmarks/scenes.hpp"
#include "benchmarks/stopwatch.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "optim/curve/fit_curve.hpp"
#include "sim/physics_run.hpp"

namespace kinetix::bench {
namespace {

using Differences = DifferencedProblem::Differences;

optim::CurveFit curve_fit(const Scene& scene, const optim::CurveVariables& v) {
  return optim::CurveFit(scene.goal, make_bend_ties(v.columns, v.per, v.symmetry, v.beta), v.cell_mm,
                         v.theta);
}

/// Times all starts of a search. Both searches stop within 1 % of the error that exact derivatives reach from each
/// start.
Figure finite_differences(const Scene& scene, Differences differences) {
  const optim::CurveFit fit = curve_fit(scene, strip(scene, 40));
  const DifferencedProblem peer(fit, differences, differences == Differences::central ? 1e-5 : 1e-7);
  const optim::MultiStartOptions options;
  double ours = 0, theirs = 0;
  int reached = 0;
  for (int k = 0; k < options.starts; ++k) {
    const Eigen::VectorXd start = curve_start(fit, k, options.seed);
    optim::SolveResult differenced;
    optim::SolverOptions goal = options.solver;
    goal.target = 1.01 * solve(fit, start, options.solver).residual_norm;
    goal.tolerance = 1e-12;
    ours += median_seconds(5, 1, [&] { solve(fit, start, goal); });
    theirs += median_seconds(3, 1, [&] { differenced = solve(peer, start, goal); });
    reached += differenced.status == optim::SolveStatus::target_reached;
  }
  return {
      fmt::format(
          "{}, 40 columns: exact derivatives against {} differences, both by Ceres, same 8 starts, to the "
          "same error",
          scene.name, differences == Differences::central ? "central" : "forward"),
      "-",
      fmt::format("{:.1f} times faster ({} of {} starts reached it)", theirs / ours, reached, options.starts),
      true};
}

/// Quick runs that still find the closed form to 1e-3 cell edges: few steps, stiff joints.
sim::PhysicsOptions quick_runs() {
  sim::PhysicsOptions options;
  options.step_s = 1.0 / 60;
  options.joint_stiffness = 1e8;
  options.settle_speed = 1e-3;
  options.contact = false;
  return options;
}

/// Result of a search with a simulation in its loop.
struct Looped {
  double seconds = 0, best = 0;
  int runs = 0;
  bool reached = false;
};

Looped search_with_runs(const SimulatedFit& fit, const Eigen::VectorXd& start, optim::SolverName name,
                        double target) {
  const DifferencedProblem differenced(fit, Differences::forward, 1e-4);
  const bool needs_slopes = name == optim::SolverName::ceres;
  optim::SolverOptions options;
  options.name = name;
  options.target = target;
  options.tolerance = 1e-12;
  options.max_evaluations = needs_slopes ? 100 : 4000;
  optim::SolveResult found;
  const double time = seconds(
      [&] { found = needs_slopes ? solve(differenced, start, options) : solve(fit, start, options); });
  return {time, found.residual_norm, fit.runs(), found.status == optim::SolveStatus::target_reached};
}

/// The whole job, search and one run that checks its design, against searches that fold every candidate in
/// the engine. All from one start, the first.
Figure simulation_in_the_loop(const Scene& scene, int columns, optim::SolverName name) {
  const optim::CurveVariables variables = strip(scene, columns);
  const model::CellSize size = walls_of(variables.cell_mm);
  const optim::CurveFit fit = curve_fit(scene, variables);
  const Eigen::VectorXd start = curve_start(fit, 0, 0);
  optim::SolveResult found;
  const double ours = median_seconds(5, 1, [&] {
    found = solve(fit, start, optim::SolverOptions{});
    const model::ExactDesign<double> design = fit.design(found.x, 1);
    model::Structure structure = make_structure(model::rectangle(columns, 1), size);
    apply(design, structure);
    sim::run_compression(structure, drive_on(structure, drive_to(structure, design.theta)));
  });
  const SimulatedFit looped(fit, size, quick_runs());
  Eigen::VectorXd r;
  looped.evaluate(found.x.head(looped.variables()), r, nullptr);
  const Looped run = search_with_runs(SimulatedFit(fit, size, quick_runs()), start.head(looped.variables()),
                                      name, 1.01 * r.norm());
  return {
      fmt::format("{}, {} columns: search and check against {} with a run of the engine for every candidate",
                  scene.name, columns,
                  name == optim::SolverName::ceres ? "Ceres by forward differences" : description(name)),
      "-",
      fmt::format("{}{:.0f} times faster ({:.0f} ms against {:.0f} ms and {} runs; {} the error {:.2e}{})",
                  run.reached ? "" : "at least ", run.seconds / ours, 1e3 * ours, 1e3 * run.seconds, run.runs,
                  run.reached ? "reached" : "stopped above", 1.01 * r.norm(),
                  run.reached ? "" : fmt::format(" at {:.2e}", run.best)),
      true};
}

}  // namespace

std::vector<Figure> search_peer_figures() {
  const std::vector<Scene> scenes = regression_scenes();
  std::vector<Figure> figures;
  for (const Scene& scene : scenes) figures.push_back(finite_differences(scene, Differences::forward));
  figures.push_back(finite_differences(scenes[1], Differences::central));
  for (const int columns : {10, 20})
    for (const optim::SolverName name : {optim::SolverName::ceres, optim::SolverName::bobyqa})
      figures.push_back(simulation_in_the_loop(scenes[1], columns, name));
  return figures;
}

}  // namespace kinetix::bench
