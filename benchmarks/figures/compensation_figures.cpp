#include <fmt/format.h>

#include <cmath>
#include <string>

#include "app/goals/display/display_outcome.hpp"
#include "app/goals/registry.hpp"
#include "app/pipeline/pipeline.hpp"
#include "benchmarks/figure.hpp"
#include "targets/document/document.hpp"

namespace kinetix::bench {
namespace {

// Number of prints that confirm the first-order forecast. Their rms is known to 3 %, and 10 % are required.
constexpr int prints = 1000;

const std::string springs = "drive: {kind: shape_memory, k_turn: 5}\n",
                  rubber = "hinge: {kind: block, material: tango, gap_mm: 1}\n";

std::string shape(const char* name) { return std::string(KINETIX_SHAPES) + "/" + name; }

/// A target written out, among the shipped ones so that it finds their points and meshes.
app::Run run_of(const std::string& text, int count, bool verify) {
  app::RunOptions options;
  options.prints = count;
  options.verify = verify;
  const targets::Node root = targets::parse_document("kinetix: 1\n" + text, shape("bench.yaml"));
  return run_goal(*app::read_target(root).goal, options);
}

const std::string
    rib = "target: {kind: curve, points: helmet_rib.csv}\n",
    cube = "target: {kind: fold, box: [4, 4, 4]}\ntolerance: {angle_deg: 1}\n",
    head =
        "target: {kind: helmet, mesh: headform.obj, ribs: 8, coverage_mm: 90, clearance_mm: 5}\n"
        "structure: {cell_mm: 6}\n",
    soft_t =
        "target: {kind: display, glyph: T}\n"
        "structure: {cells: [10, 10], cell_mm: 20, wall_mm: {thickness: 2, height: 8}}\n"
        "hinge: {kind: block, material: tango, gap_mm: 2, thickness_mm: 1.2}\n";

/// Returns the relative difference of the first-order forecast from the result of the prints.
double off_by(double said, double seen) { return std::abs(said / seen - 1); }

Figure confirmed(const std::string& what, const std::string& text) {
  const app::Run run = run_of(text, prints, false);
  if (!run.printed || !run.printed->runs) return {what, "within 10 %", "not known", false};
  const model::ToleranceResult& made = run.printed->made;
  const model::PrintRuns& seen = *run.printed->runs;
  return {
      what, "within 10 %",
      fmt::format("rms {:.3f} mm to first order, {:.3f} mm in {} prints ({:.1f} %); 95 of 100 within {:.3f} "
                  "and {:.3f} mm",
                  made.rms_mm, seen.rms_mm, seen.prints, 100 * off_by(made.rms_mm, seen.rms_mm), made.p95_mm,
                  seen.p95_mm),
      seen.failed == 0 && off_by(made.rms_mm, seen.rms_mm) <= 0.1};
}

std::vector<Figure> first_order() {
  std::vector<Figure> figures = {
      confirmed(
          "as made, hinges left open and taken for soft blocks that keep their turns, cube of 4 x 4 x 4 "
          "cells: first order against prints",
          cube),
      confirmed("the same of a helix of two turns, 96 columns",
                "target: {kind: space_curve, points: helix.csv}\nstructure: {cells: [96, 1]}\n"),
      confirmed("the same of a saddle of 8 x 8 facets",
                "target: {kind: surface, shape: saddle, rise: 0.3}\n"),
      confirmed("as made, helmet rib of 40 columns, rubber hinges and springs of shape memory: first order "
                "against prints",
                rib + rubber + springs),
      confirmed("the same of the cube of 4 x 4 x 4 cells", cube + rubber + springs),
      confirmed("the same of the helmet of 844 bodies", head + rubber + springs)};
  const app::Run run = run_of(soft_t + "tolerance: {strain: 0.3}\n", prints, false);
  const auto& printed = app::measure_of<app::DisplayMeasure>(run).printed;
  figures.push_back(
      {"the same of a letter T, 10 x 10 cells: contrast", "within 10 %",
       fmt::format(
           "{:.2f} to first order, {:.2f} in {} prints; above {:.2f} and {:.2f} in 95 of 100; auc {:.3f} "
           "and {:.3f}",
           printed->expected.contrast, printed->seen.contrast, printed->prints,
           printed->expected.contrast_p05, printed->seen.contrast_p05, printed->expected.auc,
           printed->seen.auc),
       printed->failed == 0 && off_by(printed->expected.contrast, printed->seen.contrast) <= 0.1 &&
           off_by(printed->expected.contrast_p05, printed->seen.contrast_p05) <= 0.1});
  return figures;
}

/// Returns the share of the tolerance analysis in the time of a whole run with its twenty prints.
double share_of_time(const app::Run& run) {
  const app::Timings& t = run.timings;
  return t.print_tolerance /
         (t.plan + t.optimise + t.equilibrium + t.compensation + t.print_tolerance + t.verify);
}

std::vector<Figure> compensation() {
  const app::Run soft = run_of(rib + rubber + springs, 0, true);
  const app::CompensationResult& m = *soft.compensation;
  const app::Run robust = run_of(rib + rubber + springs + "robust: true\n", 0, true);
  const double plain = soft.printed->made.rms_mm, better = robust.printed->made.rms_mm;
  return {
      {"helmet rib of rubber hinges and springs of shape memory: error of the equilibrium, before and after",
       ">= 10 times smaller, or within tolerance",
       fmt::format(
           "{:.3g} mm, {:.3g} mm ({:.0f} times), {:.3g} mm allowed; physics run within {:.1e} cell edges",
           m.before_mm, m.after_mm, m.before_mm / m.after_mm, m.tolerance_mm,
           soft.verification->distance.rms),
       soft.met() && soft.verification->agrees && m.after_mm * 10 <= m.before_mm},
      {"the same, what prints come to: time of the whole run", "<= 20 %",
       fmt::format("{:.1f} %, with twenty prints", 100 * share_of_time(soft)), share_of_time(soft) <= 0.2},
      {"the same, robust: as made against the plain search, design within tolerance", "<= 0.5",
       fmt::format("{:.3f} mm, {:.3f} mm ({:.2f}); design {:.3f} mm off in matter; search {:.1f} s", better,
                   plain, better / plain, robust.compensation->after_mm, robust.timings.optimise),
       robust.met() && robust.verification->agrees && better <= 0.5 * plain}};
}

std::vector<Figure> limits() {
  const app::Run run = run_of(soft_t + "tolerance: {force_N: 50, strain: 0.3}\n", 0, true);
  const auto& display = app::outcome_of<app::DisplayOutcome>(run);
  const app::PanelLoads& loads = *display.loads;
  const std::string without = display.unlimited
                                  ? fmt::format("; without limits {:.1f} N, strain {:.2f}, auc {:.3f}",
                                                display.unlimited->hinges.force_N,
                                                display.unlimited->hinges.strain, display.unlimited->auc)
                                  : std::string("; limits cost nothing");
  const auto* physics = app::physics_measure_of<app::DisplayMeasure>(run);
  const double seen = physics ? physics->reading.score.auc : 0;
  return {{"letter T, 10 x 10 cells of 20 mm, rubber blocks of 2 x 1.2 mm, at most 50 N and strain 0.3",
           "auc >= 0.98 in model and physics run",
           fmt::format("auc {:.3f} and {:.3f}, {:.1f} N, strain {:.2f}{}", loads.auc, seen,
                       loads.hinges.force_N, loads.hinges.strain, without),
           loads.auc >= 0.98 && seen >= 0.98 && loads.hinges.force_N <= 50 && loads.hinges.strain <= 0.3 &&
               run.verification->agrees},
          {"the same: search with limits", "<= 10 s", fmt::format("{:.2f} s", run.timings.optimise),
           run.timings.optimise <= 10},
          {"the same: equilibrium against physics run", "<= 1e-2 cell edges rms",
           fmt::format("{:.1e}", run.verification->distance.rms), run.verification->distance.rms <= 1e-2}};
}

}  // namespace

std::vector<Figure> compensation_figures() {
  std::vector<Figure> figures = first_order();
  for (const auto& more : {compensation(), limits()}) figures.insert(figures.end(), more.begin(), more.end());
  return figures;
}

}  // namespace kinetix::bench
