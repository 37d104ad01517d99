#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <vector>

#include "app/goals/outline/outline_goal.hpp"
#include "app/pipeline/pipeline.hpp"
#include "benchmarks/figure.hpp"
#include "model/lattice/planar/regular_lattices.hpp"

namespace kinetix::bench {
namespace {

using Points = std::vector<Eigen::Vector2d>;

constexpr int points_of = 200;  // of a goal: finer than its panel

Points ring(double across, double high) {
  Points out;
  for (int k = 0; k < points_of; ++k) {
    const double a = 2 * pi * k / points_of;
    out.emplace_back(across * std::cos(a), high * std::sin(a));
  }
  return out;
}

Points heart() {
  Points out;
  for (int k = 0; k < points_of; ++k) {
    const double a = 2 * pi * k / points_of;
    out.emplace_back(64 * std::pow(std::sin(a), 3),
                     52 * std::cos(a) - 20 * std::cos(2 * a) - 8 * std::cos(3 * a) - 4 * std::cos(4 * a));
  }
  return out;
}

Points drop() {
  Points out;
  for (int k = 1; k < points_of; ++k) {
    const double a = 2 * pi * k / points_of;
    out.emplace_back(65 * std::sin(a) * std::pow(std::sin(a / 2), 1.5), 50 * std::cos(a));
  }
  return out;
}

Points star() {
  Points out;
  for (int k = 0; k < 10; ++k)
    out.emplace_back((k % 2 ? 40.0 : 70.0) * Eigen::Vector2d(-std::sin(pi * k / 5), std::cos(pi * k / 5)));
  return out;
}

Points square() { return {{-60, -60}, {60, -60}, {60, 60}, {-60, 60}}; }

/// A shape that the issue does not name: a rounded triangle that is a little lopsided.
Points pebble() {
  Points out;
  for (int k = 0; k < points_of; ++k) {
    const double a = 2 * pi * k / points_of, r = 60 + 7 * std::cos(3 * a) + 4 * std::sin(2 * a + 0.4);
    out.emplace_back(r * std::cos(a), r * std::sin(a));
  }
  return out;
}

app::OutlineFile whole_panel(const Points& goal, int cells) {
  app::OutlineFile file;
  file.name = "outline";
  file.folded = targets::Outline(goal);
  file.columns = file.rows = cells;
  file.trims = false;
  return file;
}

app::Run found(const app::OutlineFile& file, bool verify) {
  app::RunOptions options;
  options.verify = verify;
  return run_goal(*make_goal(file), options);
}

const app::OutlineOutcome& outline_of(const app::Run& run) {
  return app::outcome_of<app::OutlineOutcome>(run);
}

std::string words(const app::Run& run) {
  const optim::OutlineDesign& design = outline_of(run).design;
  return fmt::format("rms {:.4f}, IoU {:.3f}, theta {:.1f} deg, walls {}, {:.1f} s", design.error.rms,
                     design.error.iou, to_degrees(design.theta), design.clear ? "never meet" : "MEET",
                     run.timings.optimise);
}

Figure disc(double offset_mm, double most) {
  app::OutlineFile file = whole_panel(ring(60, 60), 12);
  file.cell_mm = 10;
  file.thickness_mm = 0.8;
  file.offset_mm = offset_mm;
  file.theta = {30 * radians_per_degree, 40 * radians_per_degree};
  const app::Run run = found(file, true);
  const optim::OutlineDesign& design = outline_of(run).design;
  return {
      fmt::format("disc from a 12 x 12 square panel, offset <= {} mm, walls of 0.8 mm", offset_mm),
      fmt::format("rms of the rim over the diagonal <= {}, theta <= 40 deg, walls never meet; physics agrees",
                  most),
      words(run), design.error.rms <= most && design.clear && run.verification->agrees};
}

/// Reports the best of all lattices, each cut to shape.
Figure shape(const std::string& name, const Points& goal) {
  std::string all;
  constexpr double min_iou = 0.95;
  double best_rms = INFINITY;
  const auto try_lattice = [&](const model::PlanarLattice* lattice, int cells) {
    app::OutlineFile file;
    file.name = "outline";
    file.folded = targets::Outline(goal);
    file.lattice.lattice = lattice;
    file.lattice.closed_boundary = lattice != nullptr;
    file.columns = file.rows = cells;
    const app::Run run = found(file, false);
    const optim::OutlineDesign& design = outline_of(run).design;
    all +=
        fmt::format("{}{} {:.4f} / {:.3f} ({:.0f} % at the offset's bound, {:.0f} % at that of t, {:.1f} s)",
                    all.empty() ? "" : "; ", file.lattice.name(), design.error.rms, design.error.iou,
                    100 * design.at_bounds_offset, 100 * design.at_bounds_shift, run.timings.optimise);
    const bool fits = design.clear && design.error.iou >= min_iou;
    if (!fits || !(design.error.rms < best_rms)) return;
    best_rms = design.error.rms;
  };
  try_lattice(nullptr, 12);
  for (const model::PlanarLattice* lattice : model::planar_lattices())
    try_lattice(lattice, lattice->corners(0, 0, pi / 3).size() == 4 ? 12 : 8);
  return {name + ", cut from a lattice: rms / IoU", "rms <= 0.015, IoU >= 0.95 with the best lattice", all,
          best_rms <= 0.015};
}

Figure timed(int cells, double max_seconds) {
  const app::Run run = found(whole_panel(ring(60, 60), cells), false);
  return {fmt::format("outline search, disc from {0} x {0} squares", cells),
          fmt::format("<= {} s", max_seconds), words(run), run.timings.optimise <= max_seconds};
}

Figure both(const std::string& name, const Points& flat, const Points& folded) {
  app::OutlineFile file = whole_panel(folded, 12);
  file.flat = targets::Outline(flat);
  const app::Run run = found(file, true);
  const optim::OutlineDesign& design = outline_of(run).design;
  const double gap = run.states.front().gaps.max;
  return {
      name + ", both outlines prescribed, 12 x 12 cells", "rms of both <= 0.01, exact at every theta",
      fmt::format("pressed {}; flat rms {:.4f}, IoU {:.3f}; hinges closed to {:.0e}, physics {}", words(run),
                  design.flat.rms, design.flat.iou, gap, run.verification->agrees ? "agrees" : "DISAGREES"),
      design.error.rms <= 0.01 && design.flat.rms <= 0.01 && design.clear && gap <= 1e-12 &&
          run.verification->agrees};
}

}  // namespace

std::vector<Figure> outline_figures() {
  return {disc(0.8, 0.01),
          disc(1.2, 0.003),
          shape("ellipse 3:2", ring(90, 60)),
          shape("drop", drop()),
          shape("heart", heart()),
          shape("star", star()),
          shape("pebble", pebble()),
          timed(12, 2),
          timed(40, 20),
          both("square to disc", square(), ring(60, 60)),
          both("disc to square", ring(60, 60), square())};
}

}  // namespace kinetix::bench
