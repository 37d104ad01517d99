#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "app/goals/display/display_file.hpp"
#include "app/goals/display/display_outcome.hpp"
#include "app/pictures/panel_picture.hpp"
#include "app/pipeline/pipeline.hpp"
#include "benchmarks/figure.hpp"
#include "model/base/parallel_runs.hpp"
#include "targets/display/glyph_goal.hpp"
#include "tests/support/recogniser.hpp"

namespace kinetix::bench {
namespace {

app::Run shown(targets::DisplayGoal goal, bool verify = true,
               optim::Channel channel = optim::Channel::aperture) {
  app::DisplayFile file;
  file.channel = channel;
  file.offset = 0;
  file.t = app::t_on_walls;
  file.name = "display";
  file.goal = std::move(goal);
  app::RunOptions options;
  options.verify = verify;
  return run_goal(*make_goal(file), options);
}

targets::DisplayGoal letter(const std::string& text, int columns, int rows) {
  return glyph_goal(text, targets::find_font(targets::default_font), columns, rows);
}

/// Returns a ramp from dark on the left to light on the right.
targets::DisplayGoal ramp(int columns, int rows) {
  std::vector<double> levels;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) levels.push_back(static_cast<double>(i) / (columns - 1));
  return targets::make_goal({columns, rows}, levels);
}

/// Returns the circle of the paper's Fig. 22, as targets/shapes/circle.yaml.
targets::DisplayGoal circle(int side) {
  std::vector<double> levels;
  const double middle = (side - 1) / 2.0, radius = side / 2.0 - 1;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) levels.push_back(std::hypot(i - middle, j - middle) <= radius ? 1 : 0);
  return targets::make_goal({side, side}, levels);
}

const app::DisplayMeasure& shown_by(const app::Run& run) { return app::measure_of<app::DisplayMeasure>(run); }
bool settled(const app::Run& run) { return run.by_physics != nullptr; }
/// @pre settled
const app::DisplayReading& physics_of(const app::Run& run) {
  return app::physics_measure_of<app::DisplayMeasure>(run)->reading;
}
double auc(const app::Run& run) { return settled(run) ? physics_of(run).score.auc : 0; }

std::string describe(const targets::DisplayScore& score) {
  return fmt::format("auc {:.3f}, contrast {:.1f}, {:.3f} apart", score.auc, score.contrast,
                     score.separation());
}

std::vector<Figure> letter_t() {
  const app::Run run = shown(letter("T", 10, 10));
  const app::DisplayMeasure& d = shown_by(run);
  const targets::DisplayScore &model = d.reading.score,
                              rule = app::outcome_of<app::DisplayOutcome>(run).design.starts[0].view.score;
  const targets::DisplayScore physics = settled(run) ? physics_of(run).score : targets::DisplayScore{};
  const std::string scene = "letter T, 10 x 10 cells, 12 % compression";
  return {{scene + ": model", "auc 1, contrast >= 6, 0.075 apart, stretch <= 0.12",
           fmt::format("{}, stretch {:.3f}", describe(model), d.stretch),
           model.auc == 1 && model.contrast >= 6 && model.separation() >= 0.075 && d.stretch <= 0.12},
          {scene + ": physics run", "auc >= 0.99, contrast >= 4, 0.065 apart", describe(physics),
           physics.auc >= 0.99 && physics.contrast >= 4 && physics.separation() >= 0.065},
          {scene + ": before compression", "contrast 0", fmt::format("{:g}", d.before.score.contrast),
           d.before.score.contrast == 0},
          {scene + ": the paper's rule alone, k = 0.15", "", describe(rule), true},
          {scene + ": time of the search", "<= 10 s", fmt::format("{:.2g} s", run.timings.optimise),
           run.timings.optimise <= 10}};
}

/// Result of a capital in the physics run, and what a text recogniser reads in its far views.
struct Capital {
  bool settled = false, restless = false;
  double auc = 0, stretch = 0;
  std::string read, read_before;
};

Capital capital(char c, optim::Channel channel) {
  const app::Run run = shown(letter(std::string(1, c), 12, 12), true, channel);
  Capital out;
  out.settled = settled(run);
  out.auc = auc(run);
  out.stretch = shown_by(run).stretch;
  if (!out.settled) return out;
  const auto& physics = run.verification->physics;
  out.restless = physics.residual_motion > 0;
  out.read = testing::read_capitals(app::far_view(run.design.structure, physics.state, testing::as_ink));
  out.read_before = testing::read_capitals(
      app::far_view(run.design.structure, rest_state(run.design.structure), testing::as_ink));
  return out;
}

struct Capitals {
  double mean = 0, least = 1, stretch = 0;
  std::string worst, restless, read, misread, read_before;
};

void add(const Capital& one, char c, Capitals& all) {
  all.mean += one.auc / 26;
  if (one.auc < all.least) all.worst = c;
  all.least = std::min(all.least, one.auc);
  all.stretch = std::max(all.stretch, one.stretch);
  if (!one.settled) return;
  if (one.restless) all.restless += c;
  (one.read == std::string(1, c) ? all.read : all.misread) += c;
  if (one.read_before == std::string(1, c)) all.read_before += c;
}

Capitals capitals(optim::Channel channel) {
  std::vector<Capital> each(26);
  model::run_in_parallel(26, 0, [&](int k) { each[k] = capital(static_cast<char>('A' + k), channel); });
  Capitals all;
  for (int k = 0; k < 26; ++k) add(each[k], static_cast<char>('A' + k), all);
  return all;
}

std::vector<Figure> capitals() {
  const std::string scene = "26 capitals, DejaVu Sans Bold, 12 x 12 cells, in the physics run";
  const auto read = [](const Capitals& all) {
    return fmt::format("{} (not {}), {} before", all.read.size(), all.misread, all.read_before.size());
  };
  const Capitals by_aperture = capitals(optim::Channel::aperture), by_area = capitals(optim::Channel::area);
  return {{scene, "mean auc >= 0.97, none under 0.93, stretch <= 0.12",
           fmt::format("mean {:.4f}, least {:.4f}{}, stretch {:.3f}{}", by_aperture.mean, by_aperture.least,
                       by_aperture.worst.empty() ? "" : " (" + by_aperture.worst + ")", by_aperture.stretch,
                       by_aperture.restless.empty()
                           ? ""
                           : "; contacts that jump to and fro at the end: " + by_aperture.restless),
           by_aperture.mean >= 0.97 && by_aperture.least >= 0.93 && by_aperture.stretch <= 0.12},
          {scene + ", searched by `channel: area`", "",
           fmt::format("mean auc {:.4f}, least {:.4f}, stretch {:.3f}", by_area.mean, by_area.least,
                       by_area.stretch),
           by_area.stretch <= 0.12},
          {"the same panels (`channel: area`) from a distance, read by tesseract",
           "at least 20 of 26 after, none before", read(by_area),
           by_area.read.size() >= 20 && by_area.read_before.empty()},
          {"the same with the default `channel: aperture`", "", read(by_aperture), true}};
}

Figure picture(const std::string& name, targets::DisplayGoal goal) {
  const app::Run run = shown(std::move(goal));
  const std::string status = settled(run) ? describe(physics_of(run).score) : "not settled";
  return {name + ", in the physics run", "auc >= 0.97", status, auc(run) >= 0.97};
}

Figure grey() {
  const app::Run run = shown(ramp(10, 10));
  const double rank = settled(run) ? physics_of(run).rank : 0;
  return {"grey ramp, 10 x 10 cells, in the physics run", "rank correlation >= 0.9",
          fmt::format("{:.3f}", rank), rank >= 0.9};
}

Figure large() {
  const app::Run run = shown(letter("T", 20, 20), false);
  return {"letter T, 20 x 20 cells: time of the search", "<= 60 s",
          fmt::format("{:.3g} s, {}", run.timings.optimise, describe(shown_by(run).reading.score)),
          run.timings.optimise <= 60};
}

}  // namespace

std::vector<Figure> display_figures() {
  std::vector<Figure> figures = letter_t();
  for (Figure& figure : capitals()) figures.push_back(std::move(figure));
  figures.push_back(picture("circle, 12 x 12 cells", circle(12)));
  figures.push_back(picture("word HI, 20 x 10 cells", letter("HI", 20, 10)));
  figures.push_back(grey());
  figures.push_back(large());
  return figures;
}

}  // namespace kinetix::bench
