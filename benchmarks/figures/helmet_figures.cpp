#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/goals/helmet/helmet_goal.hpp"
#include "app/pipeline/pipeline.hpp"
#include "app/result/result_json.hpp"
#include "benchmarks/figure.hpp"
#include "benchmarks/stopwatch.hpp"
#include "tests/targets/heads.hpp"

namespace kinetix::bench {
namespace {

app::HelmetFile headform() {
  return app::read_helmet_file(targets::read_document(std::string(KINETIX_SHAPES) + "/headform.yaml"));
}

std::string describe(double rms_mm, double max_mm) {
  return fmt::format("rms {:.3f} mm, max {:.3f} mm", rms_mm, max_mm);
}

std::vector<Figure> headform_figures() {
  const app::Run run = run_goal(*app::make_goal(headform()), {});
  const nlohmann::ordered_json metrics = metrics_json(run);
  const double rms = metrics["distance_rms_mm"], max = metrics["distance_max_mm"],
               worst = metrics["rib_rms_mm"];
  const double apart = run.verification->distance.rms;
  const std::string scene = "headform, 8 ribs, 6 mm cells";
  return {{scene + ": distance from head plus clearance", "rms <= 0.8 mm, max <= 3 mm", describe(rms, max),
           rms <= 0.8 && max <= 3},
          {scene + ": worst rib from its section curve", "<= 0.2 mm rms", fmt::format("{:.3f} mm", worst),
           worst <= 0.2},
          {scene + ": design time", "<= 1 s", fmt::format("{:.2g} s", run.timings.optimise),
           run.timings.optimise <= 1},
          {scene + ": closure of hinges", "<= 1e-12 cell edges",
           fmt::format("{:.1e}", run.states.front().gaps.max), run.states.front().gaps.max <= 1e-12},
          {fmt::format("{}: physics run, {} bodies, folded by its spine, against the model", scene,
                       run.design.structure.bodies()),
           "verify_rms <= 2e-2 cell edges",
           run.by_physics
               ? fmt::format("rms {:.1e} cell edges, {} from the head, {:.3g} s", apart,
                             describe(metrics["distance_rms_mm_physics"], metrics["distance_max_mm_physics"]),
                             run.verification->physics.seconds)
               : to_string(run.verification->physics.status) + ": " + run.verification->physics.why,
           run.by_physics && apart <= 2e-2}};
}

/// 16 ribs of 40 cells: cells small enough that ribs have that many.
Figure large() {
  app::HelmetFile file = headform();
  file.spec.ribs = 16;
  file.spec.size = {4.2, 0.42, 2.5};
  std::optional<optim::RibsDesign> found;
  const double time =
      seconds([&] { found = fit_helmet(file.head.dome, Eigen::Vector3d::Zero(), file.spec, {}); });
  const optim::RibsDesign& design = *found;
  int most = 0;
  for (const model::FishboneRib& rib : design.layout.spine_and_ribs.ribs)
    most = std::max(most, rib.cells[0] + rib.cells[1] + 1);
  return {"headform, 16 ribs of 4.2 mm cells: design time", "<= 5 s for ribs of 40 cells",
          fmt::format("{:.2g} s, ribs of up to {} cells, {} bodies, {}", time, most,
                      design.fishbone.structure.bodies.size(), describe(design.error.rms, design.error.max)),
          time <= 5 && most >= 40};
}

/// Stand-ins for scans, as there is none to ship: tests/targets/heads.hpp.
Figure scans() {
  double rms = 0, max = 0;
  std::size_t collisions = 0;
  constexpr int count = 8;
  for (unsigned seed = 1; seed <= count; ++seed) {
    const targets::Head head = make_head(testing::scanned_head(seed), {});
    optim::RibsSpec spec;
    spec.size = {6, 0.6, 3.6};
    const optim::RibsDesign design = fit_helmet(head.dome, Eigen::Vector3d::Zero(), spec, {});
    rms = std::max(rms, design.error.rms);
    max = std::max(max, design.error.max);
    collisions += design.collisions.size();
  }
  return {
      fmt::format("{} stand-ins for scans (ears, nose, noise, holes, flaps, inner shells), 8 ribs, coverage "
                  "above the ears: worst distance",
                  count),
      "rms <= 1.5 mm, max <= 5 mm",
      fmt::format("rms {:.3f} mm, max {:.3f} mm, {} walls meet", rms, max, collisions),
      rms <= 1.5 && max <= 5 && collisions == 0};
}

}  // namespace

std::vector<Figure> helmet_figures() {
  std::vector<Figure> figures = headform_figures();
  figures.push_back(large());
  figures.push_back(scans());
  return figures;
}

}  // namespace kinetix::bench
