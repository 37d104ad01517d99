#include <fmt/format.h>

#include "benchmarks/figure.hpp"
#include "benchmarks/scenes.hpp"
#include "sim/compression_run.hpp"

namespace kinetix::bench {
namespace {

Figure against_exact(const Scene& scene, int columns) {
  const CurveDesign found = fit_curve(scene.goal, strip(scene, columns), {});
  CellSize size;
  size.edge_mm = strip(scene, columns).cell_mm;
  size.thickness_mm = size.edge_mm / 10;
  size.height_mm = 0.75 * size.edge_mm;
  const Structure structure = [&] {
    Structure s = make_structure(rectangle(columns, 1), size);
    apply(found.design, s);
    return s;
  }();
  const PhysicsResult physics = run_compression(structure, drive_to(structure, found.design.theta));
  const double rms = aligned_distance(structure, physics.state, fold(found.design, structure)).rms;
  const bool settled = physics.status == PhysicsResult::Status::settled;
  const bool quick = columns != 40 || physics.seconds <= 10;
  return {fmt::format("{}, {} columns: Bullet against the exact model", scene.name, columns),
          columns == 40 ? "verify_rms <= 5e-3, gap <= 2e-3, <= 10 s" : "verify_rms <= 5e-3, gap <= 2e-3",
          fmt::format("rms {:.1e}, gap {:.1e} cell edges, {:.2f} s, {}", rms, physics.gaps.max,
                      physics.seconds, to_string(physics.status)),
          settled && rms <= 5e-3 && physics.gaps.max <= 2e-3 && quick};
}

}  // namespace

std::vector<Figure> physics_figures() {
  std::vector<Figure> figures;
  for (const Scene& scene : regression_scenes())
    for (const int columns : {10, 20, 40, 80}) figures.push_back(against_exact(scene, columns));
  return figures;
}

}  // namespace kinetix::bench
