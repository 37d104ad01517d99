#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/goals/registry.hpp"
#include "app/goals/space_curve/space_curve_goal.hpp"
#include "app/pipeline/pipeline.hpp"
#include "app/result/result_json.hpp"
#include "benchmarks/figure.hpp"
#include "model/closure/closure.hpp"
#include "model/closure/mobility.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/lattice/sodalite.hpp"
#include "sim/physics_run.hpp"
#include "targets/document/document.hpp"

namespace kinetix::bench {
namespace {

targets::SpaceGoal helix() {
  constexpr int points = 481;
  constexpr double radius = 40, pitch = 40, turns = 2;  // mm
  std::vector<Eigen::Vector3d> out;
  for (int k = 0; k < points; ++k) {
    const double turn = turns * k / (points - 1), a = 2 * pi * turn;
    out.emplace_back(radius * std::cos(a), radius * std::sin(a), pitch * turn);
  }
  return targets::SpaceGoal(out);
}

Figure helix_figure() {
  app::SpaceCurveFile file(helix());
  file.name = "helix";
  file.variables.size = {5, 0.5, 3};
  const app::Run run = run_goal(*make_goal(file), {});
  const nlohmann::ordered_json metrics = metrics_json(run);
  const double rms = metrics["shape_rms"], max = metrics["shape_max"];
  const double seconds = run.timings.optimise;
  const bool agrees = run.verification && run.verification->agrees;
  return {"helix of two turns, 96 columns", "rms <= 2.4e-3 of the diagonal, <= 1 s, physics agrees",
          fmt::format("rms {:.2e}, largest {:.2e}, {:.2f} s, {}", rms, max, seconds,
                      agrees ? "physics agrees" : "physics does not agree"),
          rms <= 2.4e-3 && seconds <= 1 && agrees};
}

constexpr model::CellSize block_size = {10, 0.8, 1};  // mm: low walls, which do not meet
constexpr double gusset = 0.2;                        // of an edge: the default of files

Figure motion_figure(int n) {
  const model::SodaliteStructure block = model::make_sodalite({n, n, n}, gusset, block_size);
  const model::ExactMotion exact = exact_motion(block);
  double gap = 0, off = 0;
  for (const double theta : {-0.6, 0.2, 0.5, 0.75}) {
    const model::State state = exact.at(theta);
    gap = std::max(gap, closure_residual(block, state).cwiseAbs().maxCoeff());
    const auto rows = plate_drive(block, model::Axis::y, 0, 1).gripped;
    const double ratio = planes_of(rows, state).distance / planes_of(rows, rest_state(block)).distance;
    off = std::max(off, std::abs(ratio - gusset - (1 - gusset) * (1 + std::cos(2 * theta)) / 2));
  }
  const model::Mobility found = mobility(block, exact);
  return {fmt::format("sodalite lattice, {} x {} x {} cells", n, n, n),
          "closure <= 1e-12, mobility 1, arms shrink as (1 + cos) / 2",
          fmt::format("{} bodies: closure {:.0e}, mobility {}, off the ratio by {:.0e}",
                      block.rotors.size() + block.gussets.size(), gap, found.dofs_along, off),
          gap <= 1e-12 && off <= 1e-12 && found.dofs_along == 1};
}

Figure physics_figure() {
  constexpr double theta = 0.4;  // rad: rotors turn by 46 degrees
  const model::SodaliteStructure block = model::make_sodalite({2, 2, 2}, gusset, block_size);
  const sim::PhysicsResult result = sim::run_compression(block, drive_to(block, theta), {});
  const double rms = aligned_distance(block, result.state, exact_motion(block).at(theta)).rms;
  return {"sodalite lattice, 2 x 2 x 2 cells, between plates in the physics run", "rms <= 1e-2 cell edges",
          fmt::format("rms {:.1e}, {}", rms, result.why), rms <= 1e-2};
}

Figure block_figure() {
  const targets::Node root = targets::parse_document(
      "kinetix: 1\ntarget: {kind: space_block, factor: [0.82, 0.86, 0.88], size_mm: [120, 120, 120]}\n",
      "block.yaml");
  const app::Run run = run_goal(*app::read_target(root).goal, {});
  const nlohmann::ordered_json metrics = metrics_json(run);
  const double model = metrics["factor_off"], physics = metrics.value("factor_off_physics", INFINITY);
  return {"block of 120 mm that shrinks to 0.82, 0.86 and 0.88 along x, y and z",
          "factors within 1e-12, within 1e-4 in the physics run",
          fmt::format("{} bodies, off by {:.0e} and {:.0e}", run.design.structure.bodies(), model, physics),
          model <= 1e-12 && physics <= 1e-4};
}

}  // namespace

std::vector<Figure> space_figures() {
  return {helix_figure(), motion_figure(2), motion_figure(3), physics_figure(), block_figure()};
}

}  // namespace kinetix::bench
