#include <fmt/format.h>

#include "benchmarks/figure.hpp"
#include "benchmarks/scenes.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "sim/physics_run.hpp"

namespace kinetix::bench {
namespace {

Figure against_exact(const Scene& scene, int columns) {
  model::Structure structure;
  const optim::FreeCurveDesign found = fitted_strip(scene, columns, structure);
  const model::ExactDesign<double>& design = found.design.design;
  const sim::PhysicsResult physics =
      sim::run_compression(structure, drive_on(structure, drive_to(structure, design.theta)));
  const double rms = aligned_distance(structure, physics.state, fold(design, structure)).rms;
  const bool settled = physics.status == sim::PhysicsResult::Status::settled;
  const bool in_time = columns != 40 || physics.seconds <= 10;
  return {fmt::format("{}, {} columns: Bullet against the exact model", scene.name, columns),
          columns == 40 ? "verify_rms <= 5e-3, gap <= 2e-3, <= 10 s" : "verify_rms <= 5e-3, gap <= 2e-3",
          fmt::format("rms {:.1e}, gap {:.1e} cell edges, {:.2f} s, {} (shape_rms {:.2e})", rms,
                      physics.gaps.max, physics.seconds, to_string(physics.status), found.design.error.rms),
          settled && rms <= 5e-3 && physics.gaps.max <= 2e-3 && in_time};
}

std::string solver_row(const std::string& name, int columns, const sim::PhysicsOptions& options) {
  model::ExactDesign<double> design;
  const model::Structure structure = arc(columns, 1, design);
  const sim::PhysicsResult run =
      run_compression(structure, drive_on(structure, drive_to(structure, design.theta)), options);
  const double rms = aligned_distance(structure, run.state, fold(design, structure)).rms;
  return fmt::format("| {} | {} | {:.2f} s | {:.1e} | {:.1e} | {} |\n", name, columns, run.seconds, rms,
                     run.gaps.max, to_string(run.status));
}

}  // namespace

std::string solver_table() {
  sim::PhysicsOptions direct, coarse;
  coarse.step_s = 1.0 / 60;
  std::string table =
      "| step | columns | time | rms error | hinge gap | status |\n|---|---|---|---|---|---|\n";
  for (const int columns : {10, 20, 40}) {
    table += solver_row("1/1000 s", columns, direct);
    table += solver_row("1/60 s", columns, coarse);
  }
  return table;
}

std::vector<Figure> physics_figures() {
  std::vector<Figure> figures;
  for (const Scene& scene : regression_scenes())
    for (const int columns : {10, 20, 40, 80}) figures.push_back(against_exact(scene, columns));
  return figures;
}

}  // namespace kinetix::bench
