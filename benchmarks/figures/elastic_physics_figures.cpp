#include <fmt/format.h>

#include "benchmarks/equilibrium_against_physics.hpp"
#include "benchmarks/stopwatch.hpp"
#include "model/elastic/equilibrium_comparison.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "sim/physics_run.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::bench {
namespace {

constexpr double limit = 1e-2;  // cell edges, rms

}  // namespace

Figure equilibrium_against_physics(const std::string& name, const model::Structure& structure,
                                   const model::LinkageDrive& drive, const model::Elasticity& elasticity) {
  model::EquilibriumPathOptions fine;
  fine.longest_step = fine.first_step = 0.01;
  model::EquilibriumPath path;
  const double time = seconds([&] {
    path = trace_equilibrium({structure, drive, exact_motion(structure)}, elasticity, fine);
  });
  sim::PhysicsOptions options;
  options.elastic = relative(elasticity, structure.size.edge_mm);
  options.planar = path.planar;
  options.spring_turn = drive.k_spring / energy_unit(elasticity, structure.size.edge_mm);
  const sim::PhysicsResult physics = run_compression(structure, drive, options);
  const model::EquilibriumComparison c =
      compare_equilibria({structure, elasticity, drive, path.planar, true}, physics.state, path.state, limit);
  const bool reached = path.stop == model::EquilibriumPath::Stop::reached,
             settled = physics.status == sim::PhysicsResult::Status::settled;
  return {name + ": equilibrium against Bullet, same stiffness", "verify_rms <= 1e-2",
          fmt::format("{}, rms {:.1e} cell edges (max {:.1e}), {} points in contact; {:.2f} s, {}; Bullet "
                      "{:.2f} s, {}",
                      to_string(c.outcome), c.distance.rms, c.distance.max, path.steps.back().contacts, time,
                      to_string(path.stop), physics.seconds, to_string(physics.status)),
          reached && settled && c.distance.rms <= limit};
}

namespace {

Figure against_equilibrium(const std::string& name, const model::Structure& structure,
                           const model::Drive& drive) {
  return equilibrium_against_physics(name, structure, drive_on(structure, drive));
}

/// Columns that twist beside basic ones: hinges strain.
Figure by_cord(double shorten_mm) {
  const model::Structure s = testing::alternating(4, 4, testing::twisting_unit, testing::basic_unit);
  std::vector<int> through;
  for (int i = 0; i <= 4; ++i) through.push_back(*s.hinge_at({{i, 1}, model::Axis::y}));
  return equilibrium_against_physics(
      fmt::format("twist sheet, 4 x 4, a cord across a row shortened by {} mm", shorten_mm), s,
      cord_drive(s, through, shorten_mm));
}

Figure by_shape_memory(double degrees) {
  const model::Structure s = testing::alternating(4, 4, testing::twisting_unit, testing::basic_unit);
  return equilibrium_against_physics(
      fmt::format("twist sheet, 4 x 4, shape memory of 20 N mm/rad in every hinge to {} deg", degrees), s,
      shape_memory_drive(s, {}, 20, degrees * radians_per_degree));
}

model::Drive pressed(double compression) { return model::Plates{.compression = compression}; }

}  // namespace

std::vector<Figure> elastic_physics_figures() {
  constexpr double degree = radians_per_degree;
  std::vector<Figure> figures;
  for (const double k : {0.1, 0.12, 0.15})
    figures.push_back(against_equilibrium(fmt::format("letter T, 10 x 10, k = {}, 16 % compression", k),
                                          testing::letter_panel(k), pressed(0.16)));
  for (const double theta : {20.0, 40.0})
    figures.push_back(against_equilibrium(
        fmt::format("twist strip of 9 columns, hinge driven to theta {} deg", theta),
        testing::twisting_strip(),
        testing::hinge_drive(testing::twisting_strip(), {{5, 0}, model::Axis::y}, theta * degree)));
  figures.push_back(against_equilibrium("gradient panel, 8 x 8, theta 20 deg", testing::gradient_panel(),
                                        testing::plates_drive(model::Axis::x, 20 * degree)));
  figures.push_back(by_cord(5));
  figures.push_back(by_shape_memory(40));
  return figures;
}

}  // namespace kinetix::bench
