#include "app/goals/display/display_goal.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <thread>
#include <tuple>

#include "app/files/process_section.hpp"
#include "app/goals/display/display_outcome.hpp"
#include "app/goals/display/display_panel.hpp"
#include "app/pipeline/drive_loads.hpp"
#include "app/pipeline/physics.hpp"
#include "app/run/goal.hpp"

namespace kinetix::app {
namespace {

// Transmittance below which a cell counts as overlapped by walls, dimensionless. Light is off by up to 0.016 if walls
// of 0.4 cell edges overlap at their vertices only (blurred_light_test).
constexpr double min_light = -0.02;

std::string lost_strokes(const targets::DisplayGoal& goal) {
  const std::string what = "strokes or gaps are thinner than a cell, so that parts of the picture are lost: ";
  if (!goal.needed) return what + "no panel that is allowed shows it whole";
  return what + fmt::format("the smallest panel that shows it whole has [{}, {}] cells", (*goal.needed)[0],
                            (*goal.needed)[1]);
}

/// Describes indistinguishable parts of letters. Empty if all are distinguishable, or if the picture is not text.
std::string describe_melting(const targets::DisplayGoal& goal, const DisplayReading& reading) {
  const targets::Topology drawn = topology(goal);
  if (!reading.seen || *reading.seen == drawn) return "";
  return fmt::format(
      "letters merge or break on the panel: {} parts with {} holes are drawn, {} and {} are visible. Use "
      "more "
      "cells",
      drawn.components, drawn.holes, reading.seen->components, reading.seen->holes);
}

std::string describe_estimate(targets::PanelSize size) {
  return fmt::format("estimate: a panel of [{}, {}] cells shows it clearly enough", size[0], size[1]);
}

/// Describes what the search reduced to keep the limits of the file.
std::string pressed_less(const DisplayFile& file, const DisplayOutcome& display) {
  const bool turned = display.design.view.turn.has_value();
  const std::string less = turned ? "less turning" : "less compression";
  if (display.limits_stopped) return less + " as far as the search tried it";
  if (!display.least_pressed) return less;
  const DisplayFile least = pressed_by(file, *display.least_pressed);
  return less + (turned ? fmt::format(", down to {:.2g} deg,", to_degrees(least.angle))
                        : fmt::format(", down to {:.2g} %,", 100 * least.compression));
}

/// Explains why the equilibrium misses a picture that the exact motion shows. Empty if the exact motion misses it too.
std::string lost_in_equilibrium(const DisplayFile& file, const DisplayOutcome& display, const Run& run) {
  if (!display.design.scaled || !violations(file, display.exact.score, display.exact.rank, "").empty())
    return "";
  const std::vector<model::PathEvent>& events = run.equilibrium->path.events;
  const bool touch = std::any_of(events.begin(), events.end(), [](const model::PathEvent& e) {
    return e.kind == model::PathEvent::Kind::contact;
  });
  const double measured_value = file.goal.is_binary() ? display.exact.score.contrast : display.exact.rank;
  return fmt::format("the ideal motion shows the picture ({} {:.2g}), but {} it",
                     file.goal.is_binary() ? "separation d'" : "rank correlation", measured_value,
                     touch ? "hinge compliance and walls in contact blur" : "hinge compliance blurs");
}

/// Returns the tolerances of the goal. Grey pictures have no contrast tolerance.
Tolerances tolerances_of(const DisplayFile& file) {
  Tolerances tolerances = {{"stretch", file.stretch}, {"auc", file.auc}};
  if (file.goal.is_binary()) tolerances.emplace_back("contrast", file.contrast);
  return tolerances;
}

/// Returns whether a larger panel can help. The picture must be whole, the panel pressed by plates, and the exact
/// motion must not show the picture either. The contrast of panels with a driven hinge does not grow with their size.
bool can_use_more_cells(const DisplayFile& file, const DisplayOutcome& display, const Run& run) {
  const optim::DisplayView& view = display.design.view;
  return file.goal.whole && view.at_equilibrium && !view.turn &&
         lost_in_equilibrium(file, display, run).empty();
}

/// Describes cells with negative light, which means that their walls overlap. Empty if there are none.
std::string below_zero(const DisplayOutcome& display, const DisplayReading& after) {
  const std::vector<double>& light = after.channel;
  const auto dark =
      std::count_if(light.begin(), light.end(), [](double of_cell) { return of_cell < min_light; });
  if (display.channel != optim::Channel::light || dark == 0) return "";
  return fmt::format("the light of {} cells is below zero: their walls overlap. Use thinner walls", dark);
}

std::vector<std::string> all_violations(const DisplayFile& file, const DisplayOutcome& display,
                                        const DisplayMeasure& shown, const Run& run) {
  std::vector<std::string> why;
  if (!display.design.view.at_equilibrium) {
    why.push_back("no equilibrium of the panel was found at this compression: compress less");
    return why;
  }
  why = violations(file, shown.reading.score, shown.reading.rank, "model");
  if (const std::string lost = lost_in_equilibrium(file, display, run); !why.empty() && !lost.empty())
    why.push_back(lost);
  if (const std::string dark = below_zero(display, shown.reading); !dark.empty()) why.push_back(dark);
  if (!(shown.stretch <= file.stretch))
    why.push_back(fmt::format("a joint separates by {:.3f} cell edges; at most {:.3f} is allowed",
                              shown.stretch, file.stretch));
  if (display.loads)
    for (const std::string& limit :
         violations(file.limits, display.loads->hinges, pressed_less(file, display)))
      why.push_back(limit);
  if (display.faint)
    why.push_back(
        "a smaller compression would be within the limits, but then letter and rest differ by less than 1 %");
  if (!display.goal.whole) why.push_back(lost_strokes(display.goal));
  if (const std::string melted = describe_melting(display.goal, shown.reading); !melted.empty())
    why.push_back(melted);
  if (shown.estimated) why.push_back(describe_estimate(*shown.estimated));
  return why;
}

constexpr int max_bodies_of_physics = 5000;  // count: the simulation takes about an hour on one core
// Search time in s per cell, measured: convex problems for hinges with offsets, elastic searches for hinges on walls.
constexpr double seconds_per_cell = 2e-4, seconds_per_stretched_cell = 0.07;
// Time in s of the equilibrium path from flat: 0.92 s for 32 x 32 cells, 51 s for 100 x 100.
constexpr double path_seconds_of_1024 = 0.92, path_exponent = 1.76;

/// Returns the state that the search computed for its design; nullopt if it found no equilibrium.
std::optional<SearchResult::Known> known_state(const optim::DisplayDesign& design) {
  if (!design.view.at_equilibrium || design.view.state.empty()) return std::nullopt;
  const bool is_exact = design.scaled && !design.refined;
  return SearchResult::Known{is_exact ? Model::exact : Model::equilibrium, design.view.state};
}

class DisplayGoal final : public Goal {
 public:
  explicit DisplayGoal(DisplayFile file) : Goal(file.name), file_(std::move(file)) {}

  Forecast forecast() const override {
    Forecast out{make_panel(file_, {file_.goal.columns, file_.goal.rows})};
    out.search_s = out.sheet.cells() * (file_.offset > 0 ? seconds_per_cell : seconds_per_stretched_cell) +
                   path_seconds_of_1024 * std::pow(out.sheet.cells() / 1024.0, path_exponent);
    out.has_physics = out.sheet.bodies() <= max_bodies_of_physics;
    const double turn = file_.by_hinge ? file_.angle : turn_of_compression(file_.compression);
    if (const auto motion = exact_motion(out.sheet)) out.folded_mm = size_of(out.sheet, motion.at(turn / 2));
    if (!file_.goal.whole) out.notes.push_back(lost_strokes(file_.goal));
    note_process(file_, out.sheet.size(), out.notes);
    return out;
  }

  SearchResult search(const RunOptions& options) const override {
    auto display = std::make_unique<DisplayOutcome>();
    display->options = search_options(file_, elasticity(), options);
    if (!(file_.offset > 0))
      check_memory({file_.goal.columns, file_.goal.rows}, options.threads,
                   display->options.starts * static_cast<int>(file_.axes.size()), memory_of_machine());
    model::Lattice panel = make_panel(file_, {file_.goal.columns, file_.goal.rows});
    display->goal = file_.goal;
    display->channel = file_.channel;
    const auto search = [&](const DisplayFile& file) {
      return search_panel(file, panel, search_options(file, elasticity(), options), options.progress);
    };
    display->design = search(file_);
    keep_limits(file_, elasticity(), *display, panel, search, options.stop);
    if (display->design.scaled) {
      const optim::DisplayView& exact = display->design.view;
      display->exact = {exact.channel, exact.score, exact.rank};
      if (file_.strain > 0) strain(panel, options, *display);
    }
    SearchResult out = described(display->design.view);
    if (display->design.view.at_equilibrium) place_hinges(display->design.view, panel);
    out.design.structure = std::move(panel);
    out.theta = drive_of(out.design).theta();
    out.known = known_state(display->design);
    out.goal = std::move(display);
    if (out.design.structure.bodies() <= max_bodies_of_physics) return out;
    out.physics.when = PhysicsRequest::When::never;  // a step costs seconds, and there are thousands
    out.notes.push_back(
        fmt::format("no simulation: {} bodies would take hours. Run `verify` on design.yaml to make one",
                    out.design.structure.bodies()));
    return out;
  }

  std::shared_ptr<const Measure> measure(const Run& run, StateOf of, const model::State& state,
                                         const RunOptions& options) const override {
    const auto& display = outcome_of<DisplayOutcome>(run);
    const model::Lattice& panel = run.design.structure;
    auto out = std::make_shared<DisplayMeasure>();
    out->reading = read_shown_panel(file_, panel, state);
    if (of == StateOf::physics) {
      out->violations = violations(file_, out->reading.score, out->reading.rank, describe(of));
      if (const std::string melted = describe_melting(display.goal, out->reading); !melted.empty())
        out->violations.push_back("in the simulation " + melted);
      return out;
    }
    out->before = read_shown_panel(file_, panel, rest_state(panel));
    out->stretch = run.states.front().gaps.max;
    const bool stopped = options.stop.stop_requested();
    if (can_use_more_cells(file_, display, run))
      out->estimated =
          estimate_panel(file_.goal, out->reading.score.contrast, file_.contrast,
                         display.design.scaled ? max_scaled_growth : std::numeric_limits<double>::infinity());
    if (!stopped) {
      options.progress("prints", 0);
      std::tie(out->printed, out->prints_unknown) = display_prints(file_, run, options);
    }
    if (out->printed) out->warnings = out->printed->why;
    out->violations = all_violations(file_, display, *out, run);
    return out;
  }

 private:
  model::Elasticity elasticity() const {
    return elasticity_of(file_.hinge, file_.physics, file_.size.edge_mm);
  }

  /// Strains a panel on purpose. If the strained panel exceeds its limits, the panel stays as it was.
  void strain(const model::Lattice& panel, const RunOptions& options, DisplayOutcome& display) const {
    const DisplayFile pressed = pressed_by(file_, display.pressed);
    optim::DisplayDesign strained = display.design;
    refine_panel(pressed, display.goal, panel, search_options(pressed, elasticity(), options), strained,
                 options.progress);
    std::optional<PanelLoads> loads;
    if (strained.refined && file_.limits.any())
      loads = panel_loads(file_, panel, strained.view, elasticity());
    if (!loads || limit_use(file_.limits, loads->hinges) <= HingeLimits::safe_share) {
      display.design = std::move(strained);
      if (loads) display.loads = loads;
      return;
    }
    display.design.evaluations = strained.evaluations;
    display.design.why += "; with strain on purpose it would exceed its limits";
    if (!display.unlimited && !display.least_pressed) display.unlimited = loads;
  }

  /// Returns the settings of the panel and its drive. If the search found no equilibrium, the drive is the file's.
  SearchResult described(optim::DisplayView& view) const {
    SearchResult out;
    out.model = Model::equilibrium;
    out.tolerances = tolerances_of(file_);
    copy_settings(out, file_);
    if (!out.design.lock) out.design.lock = LockKind::none;  // posts would be in front of the picture
    out.design.hinge.model = HingeSection::Model::elastic;
    if (!view.at_equilibrium) view.plates = plates_of(file_);
    view.plates.press = file_.press;
    out.design.drive = drive_of(view);
    return out;
  }

  DisplayFile file_;
};

constexpr double bytes_per_cell = 50e3;  // per search, measured on panels of 30 x 30 and 60 x 60 cells

constexpr double widest_stroke = 2.7;  // cells: for wider strokes contrast grows less (measured)
constexpr double largest_factor = 4;   // largest enlargement of a side, ratio

targets::PanelSize scaled_panel(const targets::DisplayGoal& goal, double factor) {
  const auto side = [factor](int cells) { return static_cast<int>(std::ceil(factor * cells - 1e-9)); };
  return {side(goal.columns), side(goal.rows)};
}

bool is_allowed_panel(targets::PanelSize size) {
  return std::max(size[0], size[1]) <= targets::max_panel_side &&
         static_cast<long>(size[0]) * size[1] <= targets::max_panel_cells;
}

}  // namespace

std::unique_ptr<Goal> make_goal(DisplayFile file) { return std::make_unique<DisplayGoal>(std::move(file)); }

extern const GoalKind display_kind = {
    .name = "display",
    .example = "target: {kind: display, glyph: T}",
    .meaning = "panel that shows a letter, a word or a picture",
    .file = {{"image", "picture"}},
    .read = [](const targets::Node& root) { return make_goal(read_display_file(root)); },
    .table = display_keys,
    .model = Model::equilibrium,
    .metrics = {
        {"contrast", "", "[separation d'](#contrast-and-auc) of the letter's cells from the rest"},
        {"auc", "",
         "[part of pairs](#contrast-and-auc) in which the cell of the letter has the higher value"},
        {"separation", "", "difference of the two means of the channel, in the channel's unit"},
        {"rank", "", "rank correlation of channel and levels"},
        {"light_letter", "", "mean transmittance of the letter's cells, a fraction of the lamp's light"},
        {"light_rest", "", "mean transmittance of the other cells"},
        {"light_ratio", "", "luminance ratio: `light_letter` over `light_rest`"},
        {"contrast_rest", "", "separation d′ before compression"},
        {"auc_rest", "", "auc before compression"},
        {"stretch_max", "cell edges", "largest joint separation"},
        {"contrast_physics", "", "separation d′ in the simulation"},
        {"auc_physics", "", "auc in the simulation"},
        {"separation_physics", "", "separation in the simulation"},
        {"rank_physics", "", "rank in the simulation"}}};

std::size_t memory_of_machine() {
  return static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

void check_memory(targets::PanelSize size, int threads, int runs, std::size_t available) {
  const int allowed =
      threads > 0 ? threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const int parallel_runs = std::min(allowed, runs);
  const double needed = bytes_per_cell * size[0] * size[1] * parallel_runs, gib = 1 << 30;
  if (needed <= static_cast<double>(available)) return;
  throw InvalidInput(
      fmt::format("a search of {} x {} cells needs about {:.1f} GiB of memory on {} threads, and this "
                  "machine has {:.1f} GiB. Give fewer cells{}",
                  size[0], size[1], needed / gib, parallel_runs, static_cast<double>(available) / gib,
                  parallel_runs > 1 ? ", or --threads 1" : ""),
      {"", 0, 0, "structure.cells"});
}

std::vector<std::string> violations(const DisplayFile& file, const targets::DisplayScore& score, double rank,
                                    const std::string& who) {
  std::vector<std::string> why;
  const bool binary = file.goal.is_binary();
  const double measured_value = binary ? score.auc : rank;
  if (!(measured_value >= file.auc))
    why.push_back(fmt::format("{}: {} {:.3f}; at least {:.3f} is required", who,
                              binary ? "auc" : "rank correlation", measured_value, file.auc));
  if (binary && !(score.contrast >= file.contrast))
    why.push_back(fmt::format("{}: separation d′ {:.2f}; at least {:.2f} is required", who, score.contrast,
                              file.contrast));
  return why;
}

double stroke_width(const targets::DisplayGoal& goal) {
  int cells = 0, edges = 0;
  for (int j = 0; j < goal.rows; ++j)
    for (int i = 0; i < goal.columns; ++i) {
      cells += goal.is_letter(i, j);
      edges += i > 0 && goal.is_letter(i, j) != goal.is_letter(i - 1, j);
      edges += j > 0 && goal.is_letter(i, j) != goal.is_letter(i, j - 1);
    }
  return 2.0 * cells / edges;
}

std::optional<targets::PanelSize> estimate_panel(const targets::DisplayGoal& goal, double contrast,
                                                 double required, double max_growth) {
  if (!goal.is_binary() || !goal.resized || !(contrast > 0 && contrast < required)) return std::nullopt;
  const double growth = std::min(max_growth, contrast * contrast / stroke_width(goal)),
               width = required * required / growth, cell = 1.0 / std::max(goal.columns, goal.rows);
  if (!(width <= widest_stroke)) return std::nullopt;
  for (double factor = 1 + cell; factor <= largest_factor + cell / 2; factor += cell) {
    const targets::PanelSize size = scaled_panel(goal, factor);
    if (!is_allowed_panel(size)) break;
    const targets::DisplayGoal larger = goal.resized(size);
    if (larger.whole && stroke_width(larger) >= width) return size;
  }
  return std::nullopt;
}

}  // namespace kinetix::app
