#include <fmt/format.h>

#include <filesystem>

#include "app/goals/registry.hpp"
#include "app/pipeline/pipeline.hpp"
#include "app/print/fit.hpp"
#include "benchmarks/figure.hpp"
#include "benchmarks/stopwatch.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::bench {
namespace {

using app::Design;

constexpr double enough_mm = 0.01;  // mm: by which polygons differ from their circles
const char* const shapes = KINETIX_SHAPES;

/// A shipped target as its search leaves it.
Design searched(const std::string& name) {
  const app::Run run =
      run_goal(*app::read_target(std::string(shapes) + "/" + name + ".yaml").goal, {.verify = false});
  Design design;
  design.name = run.design.name;
  design.structure = run.design.structure;
  design.theta = run.theta;
  design.hinge = run.design.hinge;
  design.hinge_overrides = run.design.hinge_overrides;
  return design;
}

/// Outcomes over all targets, each with every hinge and process.
struct Tally {
  int exported = 0, refused = 0, without_size = 0, crossing = 0;
  double least_left = 1e3;  ///< of what is left over what was asked less enough_mm, mm
};

void try_all(const Design& design, Tally& tally) {
  for (const model::HingeKind kind : {model::HingeKind::pin, model::HingeKind::block})
    for (const char* process : {"polyjet", "fdm", "sla"}) try {
        const app::PreparedPrint print =
            app::prepared(design, *model::find_process(process), {.kind = kind}, false);
        ++tally.exported;
        for (const model::Polyhedron& mesh : print.job.sheet.meshes) tally.crossing += !is_closed(mesh);
        tally.least_left =
            std::min(tally.least_left, print.clearance.least().mm - print.clearance.least().required_mm);
      } catch (const InvalidInput& e) {
        ++tally.refused;
        const std::string why = e.what();
        tally.without_size += why.find("a cell_mm of") == std::string::npos &&
                              why.find("stretch on the way, and pins cannot") == std::string::npos;
      }
}

Figure timed(const std::string& what, const app::PrintJob& job, const std::vector<const char*>& formats,
             double required_s) {
  const double took = seconds([&] {
    for (const char* format : formats) app::print_format(format).write(job);
  });
  return {what, fmt::format("{:g} s", required_s), fmt::format("{:.2f} s", took), took <= required_s};
}

/// Prepares a print with the least cells that can be made, from an edge on in whole mm.
app::PreparedPrint prepared_larger(Design design, double edge_mm, model::HingeKind kind) {
  constexpr double largest_mm = 60;  // mm: beyond it something else is wrong
  for (;; edge_mm += 1) try {
      if (auto* squares = design.structure.squares()) squares->size.edge_mm = edge_mm;
      return app::prepared(design, model::processes().front(), {.kind = kind}, false);
    } catch (const InvalidInput&) {
      if (edge_mm > largest_mm) throw;
    }
}

}  // namespace

std::vector<Figure> print_figures() {
  Tally tally;
  for (const char* name : {"box_with_lid", "circle", "cube", "disc", "half_circle", "headform", "heart",
                           "helmet_rib", "honeycomb_t", "letter_t", "open_tray", "rubber_rib", "rubber_t",
                           "s_curve", "spiral", "square_to_disc", "tray_in_mm", "turned_s", "word"})
    try_all(searched(name), tally);
  try_all(app::read_design(std::string(shapes) + "/rosette.yaml"), tally);
  std::vector<Figure> figures{
      {"targets x {pin, block} x {polyjet, fdm, sla}",
       "exported, or refused with the cell edge that would do, or because hinges that stretch cannot be pins",
       fmt::format("{} exported, {} refused with it, {} refused without", tally.exported,
                   tally.refused - tally.without_size, tally.without_size),
       tally.without_size == 0},
      {"bodies of those whose surface is not closed", "0", std::to_string(tally.crossing),
       tally.crossing == 0},
      {"way to the fold, 20 steps: least clearance over what was asked", "at least -0.01 mm",
       fmt::format("{:+.4f} mm", tally.least_left), tally.least_left >= -enough_mm}};
  const Design letter = searched("letter_t"), helmet = searched("headform");
  app::PreparedPrint t;
  const double solids = seconds([&] { t = prepared_larger(letter, 10, model::HingeKind::block); });
  figures.push_back(
      {"letter T, blocks: solids and the way to the fold", "-", fmt::format("{:.2f} s", solids), true});
  figures.push_back(timed("letter T, blocks: stl, 3mf, glb", t.job, {"stl", "3mf", "glb"}, 3));
  figures.push_back(timed("letter T, blocks: step", t.job, {"step"}, 15));
  const app::PreparedPrint pinned_t = prepared_larger(letter, 36, model::HingeKind::pin);
  figures.push_back(timed("letter T, pins: stl, 3mf, glb", pinned_t.job, {"stl", "3mf", "glb"}, 3));
  figures.push_back(timed("letter T, pins: step", pinned_t.job, {"step"}, 15));
  const double all = seconds(
      [&] { app::print_format("stl").write(prepared_larger(helmet, 6.5, model::HingeKind::pin).job); });
  figures.push_back(
      {"helmet of 844 bodies, pins: all of it and stl", "20 s", fmt::format("{:.2f} s", all), all <= 20});
  return figures;
}

}  // namespace kinetix::bench
