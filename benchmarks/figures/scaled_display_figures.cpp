#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "app/goals/display/display_file.hpp"
#include "app/goals/display/display_outcome.hpp"
#include "app/pictures/panel_picture.hpp"
#include "app/pipeline/pipeline.hpp"
#include "benchmarks/figure.hpp"
#include "benchmarks/stopwatch.hpp"
#include "model/base/parallel_runs.hpp"
#include "targets/display/display_goal.hpp"
#include "targets/display/glyph_goal.hpp"
#include "tests/support/recogniser.hpp"

namespace kinetix::bench {
namespace {

constexpr int side = 12;              // cells: what a capital needs to keep its serifs
constexpr unsigned display_seed = 1;  // any: another gives bits as hard

app::Run shown_by(bool by_hinge, bool press, targets::DisplayGoal goal) {
  app::DisplayFile file;
  file.name = "display";
  file.goal = std::move(goal);
  file.by_hinge = by_hinge;
  file.press = press;
  return run_goal(*make_goal(file), {});
}

app::Run shown(targets::DisplayGoal goal, double offset, bool verify,
               const app::PhysicsSection& physics = {}) {
  app::DisplayFile file;
  file.physics = physics;
  file.name = "display";
  file.goal = std::move(goal);
  file.offset = offset;
  app::RunOptions options;
  options.verify = verify;
  return run_goal(*make_goal(file), options);
}

const app::DisplayOutcome& display_of(const app::Run& run) {
  return app::outcome_of<app::DisplayOutcome>(run);
}

/// Returns the Auc of the settled physics run; 0 if it did not settle.
double physics_auc(const app::Run& run) {
  const auto* physics = app::physics_measure_of<app::DisplayMeasure>(run);
  return physics ? physics->reading.score.auc : 0;
}
/// @pre its physics run settled
double physics_contrast(const app::Run& run) {
  return app::physics_measure_of<app::DisplayMeasure>(run)->reading.score.contrast;
}

double load_of(const app::Run& run) { return std::abs(run.equilibrium->path.steps.back().load); }

/// Results over the letters that kinematics.md names.
struct Letters {
  double exact_gap = 0, light = 1, area = 1, ratio = INFINITY, free = INFINITY;
  double physics_light = 1, load = 0, stretch_mm = 0, seconds = 0;
};

void add(const app::Run& run, Letters& all) {
  const app::DisplayOutcome& display = display_of(run);
  const std::vector<double> levels = levels_of(display.goal, run.design.structure);
  const model::State& exact = display.design.view.state;
  const auto area =
      targets::display_score(channel_values(optim::Channel::area, run.design.structure, exact), levels);
  all.exact_gap = std::max(all.exact_gap, hinge_gaps(run.design.structure, exact).max);
  all.light = std::min(all.light, display.exact.score.auc);
  all.area = std::min(all.area, area.auc);
  all.ratio = std::min(all.ratio, area.letter / area.rest);
  all.free = std::min(all.free, run.plan.free_range->positive.theta);
  all.physics_light = std::min(all.physics_light, physics_auc(run));
  all.load = std::max(all.load, load_of(run));
  all.stretch_mm =
      std::max(all.stretch_mm, run.verification->physics.gaps.max * run.design.structure.size().edge_mm);
  all.seconds = std::max(all.seconds, run.timings.optimise);
}

constexpr const char* letter_texts[] = {"T", "B", "E", "S", "R", "Q"};

/// Runs each letter in parallel, for rows that report no time.
std::vector<app::Run> letter_runs(const std::function<app::Run(targets::DisplayGoal)>& run) {
  std::vector<app::Run> runs(std::size(letter_texts));
  model::run_in_parallel(static_cast<int>(runs.size()), 0,
                         [&](int k) { runs[k] = run(targets::glyph_goal(letter_texts[k], side, side)); });
  return runs;
}

std::vector<Figure> letters() {
  Letters all, thin;
  for (const char* text : letter_texts) add(shown(targets::glyph_goal(text, side, side), 0.08, true), all);
  for (const app::Run& run : letter_runs([](auto goal) { return shown(std::move(goal), 0.04, true); }))
    add(run, thin);
  const std::string scene = "T, B, E, S, R, Q, 12 x 12 cells, rows straight, ";
  constexpr double apart = 36 * radians_per_degree;  // that walls shall stay apart to
  return {{scene + "offset <= 0.8 mm: exact state",
           "closed to 1e-12, auc of light and area >= 0.99, area ratio >= 1.25, walls apart to 36 deg",
           fmt::format("closed to {:.0e}, auc {:.3f} and {:.3f}, ratio {:.3f}, walls apart to {:.1f} deg",
                       all.exact_gap, all.light, all.area, all.ratio, to_degrees(all.free)),
           all.exact_gap <= 1e-12 && all.light >= 0.99 && all.area >= 0.99 && all.ratio >= 1.25 &&
               all.free >= apart},
          {scene + "between plates in the physics run, k_point 1000, k_turn 0.1",
           "auc of light >= 0.97, load <= 10 N, stretch <= 0.01 mm",
           fmt::format("auc {:.3f}, load {:.2f} N, stretch {:.5f} mm", all.physics_light, all.load,
                       all.stretch_mm),
           all.physics_light >= 0.97 && all.load <= 10 && all.stretch_mm <= 0.01},
          {scene + "offset <= 0.4 mm (a film at a face of the wall)", "auc of light >= 0.98",
           fmt::format("auc {:.3f}", thin.light), thin.light >= 0.98},
          {scene + "longest search", "<= 0.2 s", fmt::format("{:.3f} s", all.seconds), all.seconds <= 0.2}};
}

/// Runs a start of the letters in turn, with the first motion of each part disturbed by up to half its spin.
app::Run disturbed_run(int start) {
  const std::string texts = "TBESRQ";
  app::PhysicsSection physics;
  physics.disturbance = 0.5;
  physics.disturbance_seed = start;
  const std::string text(1, texts[start % texts.size()]);
  return shown(targets::glyph_goal(text, side, side), 0.08, true, physics);
}

Figure disturbed() {
  constexpr int starts = 20;
  std::vector<app::Run> runs(starts);
  model::run_in_parallel(starts, 0, [&](int k) { runs[k] = disturbed_run(k); });
  int right = 0;
  double light = 1, farthest = 0;
  for (const app::Run& run : runs) {
    right += run.verification->agrees ? 1 : 0;
    farthest = std::max(farthest, run.verification->distance.max);
    light = std::min(light, physics_auc(run));
  }
  return {fmt::format("T, B, E, S, R, Q, 12 x 12 cells: physics run from {} disturbed starts", starts),
          "all on the right side, auc of light >= 0.97",
          fmt::format("{} of {}, auc {:.3f}, bodies within {:.1e} cell edges of the model", right, starts,
                      light, farthest),
          right == starts && light >= 0.97};
}

/// Measures displays whose rows no plates keep straight: one hinge moves all.
Figure free_rows() {
  Letters all;
  double farthest = 0;
  for (const app::Run& run : letter_runs([](auto goal) { return shown_by(true, false, std::move(goal)); })) {
    add(run, all);
    farthest = std::max(farthest, run.verification->agrees ? run.verification->distance.max : INFINITY);
  }
  return {"T, B, E, S, R, Q, 12 x 12 cells, rows free, offset <= 0.8 mm: one hinge driven, physics run",
          "area ratio above the 1.25 of straight rows, auc of light >= 0.97",
          fmt::format(
              "ratio {:.3f}, auc {:.3f} (area {:.3f}), {:.1f} N mm, stretch {:.5f} mm, bodies within {:.1e} "
              "cell edges of the model",
              all.ratio, all.physics_light, all.area, all.load, all.stretch_mm, farthest),
          all.ratio > 1.25 && all.physics_light >= 0.97 && farthest <= 1e-3};
}

/// Measures displays designed with straight rows, between plates that push the rows' vertices and let them go.
Figure pressed() {
  Letters all;
  int agree = 0, let_go = 0;
  double farthest = 0;
  for (const app::Run& run : letter_runs([](auto goal) { return shown_by(false, true, std::move(goal)); })) {
    add(run, all);
    agree += run.verification->agrees;
    farthest = std::max(farthest, run.verification->distance.max);
    let_go = std::max(let_go, run.equilibrium->path.let_go);
  }
  return {
      "T, B, E, S, R, Q, 12 x 12 cells, rows straight, between plates that press without gripping: physics "
      "run",
      "all on the right side, auc of light >= 0.97",
      fmt::format(
          "{} of 6, auc {:.3f}, load {:.2f} N, up to {} of 26 vertices let go, bodies within {:.1e} cell "
          "edges of the model",
          agree, all.physics_light, all.load, let_go, farthest),
      agree == 6 && all.physics_light >= 0.97};
}

/// Compares a display with a small intended strain with one without.
Figure strained() {
  const auto letter_t = [](double strain) {
    app::DisplayFile file;
    file.name = "display";
    file.goal = targets::glyph_goal("T", side, side);
    file.strain = strain;
    return run_goal(*make_goal(file), {});
  };
  const app::Run plain = letter_t(0), run = letter_t(0.005);
  const auto words = [](const app::Run& of) {
    return fmt::format("contrast {:.1f}, {:.1f} N, {:.3f} mm", physics_contrast(of), load_of(of),
                       of.verification->physics.gaps.max * of.design.structure.size().edge_mm);
  };
  const double gain = physics_contrast(run) / physics_contrast(plain);
  return {"T, 12 x 12 cells, hinges strained on purpose by up to 0.05 mm: physics run",
          "clearer than without, stretch <= 0.05 mm (no figure asked)",
          fmt::format("{}; without: {}; search {:.1f} s", words(run), words(plain), run.timings.optimise),
          gain > 1 && run.verification->physics.gaps.max <= 0.00501 && run.verification->agrees};
}

struct CapitalRead {
  std::string after, before;
};

CapitalRead read_capital(const std::string& text) {
  const app::Run run = shown(targets::glyph_goal(text, side, side), 0.08, false);
  const auto seen = [&](const model::State& state) {
    return testing::read_capitals(app::far_view(run.design.structure, state, testing::as_ink));
  };
  return {seen(run.states.front().poses), seen(rest_state(run.design.structure))};
}

Figure capitals() {
  std::vector<CapitalRead> each(26);
  const auto text = [](int k) { return std::string(1, static_cast<char>('A' + k)); };
  model::run_in_parallel(26, 0, [&](int k) { each[k] = read_capital(text(k)); });
  std::string read, misread, before;
  for (int k = 0; k < 26; ++k) {
    (each[k].after == text(k) ? read : misread) += text(k);
    if (each[k].before == text(k)) before += text(k);
  }
  return {"26 capitals, 12 x 12 cells, default settings: read from a distance by tesseract",
          ">= 24 after compression, none before",
          fmt::format("{} (not {}), {} before", read.size(), misread.empty() ? "-" : misread, before.size()),
          read.size() >= 24 && before.empty()};
}

Figure bits() {
  constexpr int cells = 29;
  std::mt19937 random(display_seed);
  std::vector<double> levels;
  for (int k = 0; k < cells * cells; ++k) levels.push_back(static_cast<double>(random() % 2));
  const app::Run run = shown(targets::make_goal({cells, cells}, levels), 0.08, false);
  return {"random bits, 29 x 29 cells: search", "<= 1 s",
          fmt::format("{:.3f} s, auc of light {:.3f}", run.timings.optimise, display_of(run).exact.score.auc),
          run.timings.optimise <= 1};
}

Figure greys(const std::string& name, int cells, double max_seconds, double min_rank,
             double (*level)(double x, double y)) {
  std::vector<double> levels;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) levels.push_back(level((i + 0.5) / cells, (j + 0.5) / cells));
  const model::Structure panel = model::make_sheet(cells, cells, {});
  const targets::DisplayGoal goal = targets::make_goal({cells, cells}, levels);
  optim::DisplayDesign found;
  const double time = seconds([&] {
    found = fit_scaled_display(panel, levels_of(goal, panel), optim::Channel::light, {model::Axis::y}, {});
  });
  return {fmt::format("{}, {} x {} cells", name, cells, cells),
          fmt::format("rank correlation of light >= {}, <= {} s", min_rank, max_seconds),
          fmt::format("{:.3f}, {:.2f} s", found.view.rank, time),
          found.view.rank >= min_rank && time <= max_seconds};
}

/// Returns a smooth level with detail of a tenth of the picture, as a photograph has.
double photograph(double x, double y) {
  return std::clamp(0.5 * (x + y) + 0.3 * std::sin(15 * x) * std::sin(15 * y), 0.0, 1.0);
}

}  // namespace

std::vector<Figure> scaled_display_figures() {
  std::vector<Figure> figures = letters();
  figures.push_back(disturbed());
  figures.push_back(free_rows());
  figures.push_back(pressed());
  figures.push_back(strained());
  figures.push_back(capitals());
  figures.push_back(bits());
  figures.push_back(greys("grey ramp", 40, 10, 0.98, [](double x, double) { return x; }));
  figures.push_back(greys("photograph", 40, 10, 0.9, photograph));
  figures.push_back(greys("photograph", 100, 10, 0.9, photograph));
  return figures;
}

}  // namespace kinetix::bench
