#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "app/goals/fold/fold_goal.hpp"
#include "app/goals/fold/fold_shape.hpp"
#include "app/pipeline/pipeline.hpp"
#include "benchmarks/figure.hpp"

namespace kinetix::bench {
namespace {

app::Run folded(const targets::FoldGoal& goal, bool verify) {
  app::FoldFile file;
  file.name = "fold";
  file.goal = goal;
  file.size = {10, 0.8, 6};
  app::RunOptions options;
  options.verify = verify;
  return run_goal(*make_goal(file), options);
}

std::vector<Figure> cube() {
  const app::Run run = folded(targets::box_goal({4, 4, 4}), true);
  const auto& fold = app::outcome_of<app::FoldOutcome>(run);
  const double miss = to_degrees(fold.shape.largest_miss(fold.shape.error)), rms = fold.shape.error.rms;
  const auto* settled = app::physics_measure_of<app::FoldMeasure>(run);
  const double physics = settled ? settled->error.rms : INFINITY;
  const double verify = run.verification ? run.verification->distance.rms : INFINITY;
  const std::string scene = "cube, 4 x 4 x 4 cells";
  return {{scene + ": crease angles", "90 deg within 1e-6",
           fmt::format("within {:.1e} deg, {} columns a crease", miss,
                       fold.shape.creases[0].section["columns"].get<int>()),
           run.met() && miss <= 1e-6},
          {scene + ": faces against the solid, model", "rms <= 0.02 of the edge", fmt::format("{:.1e}", rms),
           rms <= 0.02},
          {scene + ": faces against the solid, physics run", "rms <= 0.03 of the edge",
           fmt::format("{:.1e}", physics), physics <= 0.03},
          {scene + ": physics run against the model", "<= 1e-2 cell edges", fmt::format("{:.1e}", verify),
           verify <= 1e-2}};
}

/// All boxes from 1 x 1 x 1 to 6 x 4 x 3 with a >= b >= c.
std::vector<Figure> boxes() {
  int count = 0, folding = 0, settled = 0;
  double slowest = 0, worst_faces = 0, worst_verify = 0;
  std::string refused;
  for (int a = 1; a <= 6; ++a)
    for (int b = 1; b <= std::min(a, 4); ++b)
      for (int c = 1; c <= std::min(b, 3); ++c) {
        const app::Run run = folded(targets::box_goal({a, b, c}), true);
        const auto* physics = app::physics_measure_of<app::FoldMeasure>(run);
        ++count;
        folding += run.met();
        slowest = std::max(slowest, run.timings.optimise);
        if (!run.met()) refused += fmt::format("; {} x {} x {}: {}", a, b, c, run.violations.back());
        if (!physics) continue;
        ++settled;
        worst_faces = std::max(worst_faces, physics->error.rms);
        worst_verify = std::max(worst_verify, run.verification->distance.rms);
      }
  const std::string scene = fmt::format("{} boxes from 1 x 1 x 1 to 6 x 4 x 3 cells", count);
  return {{scene + ", faces kept apart on the way", "every one folds, or a reason why not",
           fmt::format("{} fold{}", folding, refused), folding == count},
          {scene + ": in the physics run", "faces <= 0.03 of the edge, <= 1e-2 cell edges from the model",
           fmt::format("{} settle, faces {:.1e}, {:.1e}", settled, worst_faces, worst_verify),
           settled == count && worst_faces <= 0.03 && worst_verify <= 1e-2},
          {scene + ": slowest design", "<= 1 s", fmt::format("{:.2g} s", slowest), slowest <= 1}};
}

/// Folds every way to cut the cube open, each by itself.
Figure unfoldings() {
  const targets::FoldGoal cube = targets::box_goal({4, 4, 4});
  int folding = 0;
  for (const targets::FoldNet& net : cube.nets) folding += folded(targets::net_goal(net), false).met();
  return {"cube, 4 x 4 x 4 cells: unfoldings that fold without a face crossing another", "of 11",
          std::to_string(folding), folding == 11};
}

}  // namespace

std::vector<Figure> fold_figures() {
  std::vector<Figure> figures = cube();
  for (Figure& figure : boxes()) figures.push_back(std::move(figure));
  figures.push_back(unfoldings());
  return figures;
}

}  // namespace kinetix::bench
