#include "app/goals/display/display_panel.hpp"

#include <fmt/format.h>

#include "app/pipeline/closed_form.hpp"
#include "app/pipeline/equilibrium.hpp"
#include "app/pipeline/print_tolerance.hpp"
#include "app/result/print_evidence.hpp"

namespace kinetix::app {
namespace {

optim::ScaledDisplayOptions scaled_options(const DisplayFile& file) {
  optim::ScaledDisplayOptions options;
  options.compression = file.compression_range.value_or(std::array{file.compression, file.compression});
  options.offset = file.offset;
  options.t = file.t;
  if (!file.by_hinge) return options;
  options.free_to = file.angle / 2;
  options.hinge = file.driven_hinge;
  return options;
}

}  // namespace

model::Plates plates_of(const DisplayFile& file) {
  return {.axis = file.axes.front(), .compression = file.compression};
}

optim::DisplayOptions search_options(const DisplayFile& file, const model::Elasticity& elasticity,
                                     const RunOptions& run) {
  optim::DisplayOptions options;
  options.channel = file.channel;
  options.plates = plates_of(file);
  options.axes = file.axes;
  options.compression = file.compression_range;
  options.elasticity = elasticity;
  options.stretch = file.stretch;
  options.t = file.t;
  options.symmetry = file.symmetry;
  options.starts = file.solver.starts.value_or(options.starts);
  options.threads = run.threads;
  options.seed = run.seed;
  options.solver.stop = run.stop;
  options.solver.name = file.solver.name.value_or(options.solver.name);
  options.solver.max_evaluations = file.solver.max_evaluations.value_or(options.solver.max_evaluations);
  return options;
}

optim::DisplayDesign search_panel(const DisplayFile& file, const model::Lattice& panel,
                                  const optim::DisplayOptions& options, const Progress& progress) {
  const std::vector<double> levels = levels_of(file.goal, panel);
  if (file.offset > 0)
    return fit_scaled_display(panel, levels, file.channel, file.axes, scaled_options(file));
  return fit_display(*panel.squares(), levels, options, progress);
}

void refine_panel(const DisplayFile& file, const targets::DisplayGoal& goal, const model::Lattice& panel,
                  optim::DisplayOptions options, optim::DisplayDesign& design, const Progress& progress) {
  progress("strain on purpose", 0);
  options.offset = file.offset;
  options.stretch = file.strain;
  refine_display(panel, levels_of(goal, panel), options, design);
  progress("strain on purpose", 1);
}

// Offsets pass through mm, so that they equal those read back from a file to the last bit.
void place_hinges(const optim::DisplayView& view, model::Lattice& panel) {
  const double mm = panel.size().edge_mm;
  for (int h = 0; h < panel.hinges(); ++h) {
    model::HingeParameters& p = panel.hinge(h);
    p.t = view.t[h];
    if (view.offset.size() > 0) p.offset = view.offset[h] * mm / mm;
  }
}

DisplayReading read_panel(const DisplayFile& file, const model::Lattice& panel, const model::State& state) {
  const std::vector<double> levels = levels_of(file.goal, panel);
  DisplayReading out;
  out.channel = channel_values(file.channel, panel, state);
  out.channel.resize(levels.size());
  out.score = targets::display_score(out.channel, levels);
  out.rank = targets::rank_correlation(out.channel, levels);
  return out;
}

DisplayReading read_shown_panel(const DisplayFile& file, const model::Lattice& panel,
                                const model::State& state) {
  DisplayReading out = read_panel(file, panel, state);
  if (file.goal.is_binary() && file.channel != optim::Channel::light) {
    std::vector<double> light = channel_values(optim::Channel::light, panel, state);
    light.resize(out.channel.size());
    const targets::DisplayScore score = targets::display_score(light, levels_of(file.goal, panel));
    out.light = {score.letter, score.rest};
  }
  if (file.goal.is_text) out.seen = seen_topology(file.goal, in_order_of_goal(file.goal, panel, out.channel));
  return out;
}

model::Drive drive_of(const optim::DisplayView& view) {
  if (view.turn) return *view.turn;
  return view.plates;
}

model::Lattice make_panel(const DisplayFile& file, targets::PanelSize size) {
  return make_sheet(file.lattice, model::lattice_cells(size[0], size[1]), file.size);
}

namespace {

// Halvings in the search for the largest allowed compression: 2^-7 is below a hundredth of the requested compression.
constexpr int press_halvings = 7;
// Shares of the requested compression. The search starts at first_share, where most panels keep their limits. It tries
// no share below min_share, at which turns of hinges and differences of cells are a tenth of the full ones.
constexpr double first_share = 0.1, min_share = 0.01;
// Least difference of letter and rest, as a ratio to the mean of the rest. An eye distinguishes about 1 % (Weber's
// fraction).
constexpr double least_apart = 0.01;

}  // namespace

DisplayFile pressed_by(DisplayFile file, double share) {
  if (share == 1) return file;
  file.compression *= share;
  file.angle *= share;
  file.compression_range.reset();
  return file;
}

PanelLoads panel_loads(const DisplayFile& file, const model::Lattice& basic, optim::DisplayView view,
                       const model::Elasticity& elasticity) {
  view.plates.press = file.press;
  model::Lattice panel = basic;
  place_hinges(view, panel);
  const model::LinkageDrive drive = drive_on(panel, drive_of(view));
  const model::EquilibriumPath path =
      trace_equilibrium({panel, drive, exact_motion(panel)}, elasticity, path_of_run(true));
  PanelLoads loads;
  loads.hinges = hinge_loads(path, drive, panel, file.hinge);
  loads.compression = view.turn ? NAN : view.plates.compression;
  if (view.turn) loads.turn = view.turn->angle;
  const DisplayReading seen = read_panel(file, panel, path.state);
  loads.auc = seen.score.auc;
  loads.contrast = seen.score.contrast;
  loads.rank = seen.rank;
  loads.apart = std::abs(seen.score.separation()) / std::abs(seen.score.rest);
  loads.stretch = path.gaps.max;
  return loads;
}

void keep_limits(const DisplayFile& file, const model::Elasticity& elasticity, DisplayOutcome& display,
                 model::Lattice& panel, const std::function<optim::DisplayDesign(const DisplayFile&)>& search,
                 const std::stop_token& stop) {
  if (!file.limits.any()) return;
  display.loads = panel_loads(file, panel, display.design.view, elasticity);
  if (limit_use(file.limits, display.loads->hinges) <= HingeLimits::safe_share) return;
  display.unlimited = display.loads;
  const auto keeps = [&](double share, double) -> std::optional<bool> {
    if (stop.stop_requested()) return std::nullopt;
    optim::DisplayDesign design = search(pressed_by(file, share));
    if (stop.stop_requested()) return std::nullopt;  // it may have been cut short
    const PanelLoads loads = panel_loads(file, panel, design.view, elasticity);
    if (!(limit_use(file.limits, loads.hinges) <= HingeLimits::safe_share)) return false;
    if (!(loads.apart >= least_apart)) return true;
    display.design = std::move(design);
    display.loads = loads;
    display.pressed = share;
    return true;
  };
  const LimitRange found = halve({}, {press_halvings, 0, first_share, min_share}, keeps);
  if (display.pressed < 1) return;
  display.limits_stopped = stop.stop_requested();
  display.least_pressed = found.exceeded;
  display.faint = found.kept > 0;
  display.unlimited.reset();
}

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Cells: for more, the derivatives of all cells take longer than the search.
constexpr int max_printed_cells = 400;

/// Computes the derivatives of all readings by every hinge's t, alpha, beta and offset, times its standard deviation.
/// They belong to the smooth approximation of the channel (optim::SmoothChannel), because the channel has none.
/// @param state moved to the equilibrium   @return nullopt without a stable equilibrium
std::optional<MatrixXd> derivatives(const DisplayFile& file, const Run& run,
                                    const model::HingeScatter& scatter, model::State& state,
                                    Eigen::Index cells) {
  const Equilibrium& equilibrium = *run.equilibrium;
  const double theta = equilibrium.path.theta;
  model::ElasticSystem system(run.design.structure, equilibrium.elasticity, equilibrium.drive, true, true);
  system.set_multiplier(equilibrium.path.multiplier);
  model::TangentStiffness tangent(system.dofs());
  if (!settle(system, theta, state, tangent)) return std::nullopt;
  const model::Linkage panel(run.design.structure);
  const optim::SmoothChannel channel(file.channel, panel, state);
  const Eigen::Matrix4Xd spread = scatter.by_hinge(run.design.structure.hinges());
  const model::DesignSensitivities by_design(system, state, theta, tangent);
  MatrixXd out(cells, 4 * run.design.structure.hinges());
  for (Eigen::Index k = 0; k < cells; ++k) {
    model::PanelGradient reading(run.design.structure);
    channel.add_gradient(VectorXd::Unit(static_cast<Eigen::Index>(channel.values().size()), k), reading);
    Eigen::Matrix4Xd by = by_design.of(reading.state).hinges;
    by.row(0) += reading.t.transpose();
    by.row(3) += reading.offset.transpose();
    out.row(k) = by.cwiseProduct(spread).reshaped().transpose();
  }
  return out;
}

/// First-order model of the readings of prints.
struct FirstOrderPanel {
  std::vector<double> levels, readings;  ///< levels and design readings of each cell
  MatrixXd by_errors;                    ///< change of readings per standard deviation of each error

  targets::DisplayScore score(const Eigen::Matrix4Xd& errors, const model::HingeScatter& scatter) const {
    const Eigen::Matrix4Xd sd = scatter.by_hinge(errors.cols());
    const VectorXd by_sd = (sd.array() > 0).select(errors.array() / sd.array().max(1e-300), 0).reshaped();
    const VectorXd change = by_errors * by_sd;
    std::vector<double> print = readings;
    for (std::size_t k = 0; k < print.size(); ++k) print[k] += change[static_cast<Eigen::Index>(k)];
    return targets::display_score(print, levels);
  }
};

/// Contrasts and auc of sampled prints.
struct PrintScores {
  std::vector<double> contrasts;
  double auc = 0;  ///< sum over all prints

  void add(const targets::DisplayScore& score) {
    contrasts.push_back(score.contrast);
    auc += score.auc;
  }
  double mean() const {
    double sum = 0;
    for (const double contrast : contrasts) sum += contrast;
    return sum / static_cast<double>(contrasts.size());
  }
  double sd() const {
    double squares = 0;
    for (const double contrast : contrasts) squares += (contrast - mean()) * (contrast - mean());
    return std::sqrt(squares / static_cast<double>(contrasts.size()));
  }
};

// Ratio to the contrast: sampled prints that differ less from their first-order estimate do not correct it.
constexpr double first_order_threshold = 0.05;

/// Corrects the first-order estimate by the difference between the sampled prints and their own first-order estimate.
void correct_expected(const PrintScores& seen, const PrintScores& first_order,
                      optim::DisplayTolerance& expected) {
  const double more = seen.mean() - first_order.mean(), below = expected.contrast - expected.contrast_p05;
  if (!(std::abs(more) > first_order_threshold * std::abs(first_order.mean()))) return;
  const auto count = static_cast<double>(seen.contrasts.size());
  expected.contrast += more;
  expected.contrast_p05 =
      expected.contrast - below * (first_order.sd() > 0 ? seen.sd() / first_order.sd() : 1);
  expected.auc = std::clamp(expected.auc + (seen.auc - first_order.auc) / count, 0.0, 1.0);
}

/// Samples prints, solves each for its equilibrium, and adds their contrast and auc.
void add_prints(const DisplayFile& file, const Run& run, const model::HingeScatter& scatter,
                const model::State& state, const FirstOrderPanel& panel, const RunOptions& options,
                PrintedDisplay& out) {
  PrintScores scores, first_order;
  const auto seen = [&](const model::State&, const model::State& print, const Eigen::Matrix4Xd& errors) {
    scores.add(read_panel(file, printed_sheet(run.design.structure, errors), print).score);
    first_order.add(panel.score(errors, scatter));
  };
  model::ToleranceOptions as_in_the_model = print_options(options, true);
  as_in_the_model.contact = true;
  out.failed = visit_prints(
      [&](const Eigen::Matrix4Xd& errors) { return printed_sheet(run.design.structure, errors); },
      run.equilibrium->elasticity, run.equilibrium->drive, state, scatter, prints_of(options),
      as_in_the_model, seen);
  out.prints = static_cast<int>(scores.contrasts.size());
  if (scores.contrasts.empty()) return;
  out.seen.contrast = scores.mean();
  out.first_order_contrast = first_order.mean();
  out.seen.auc = scores.auc / out.prints;
  correct_expected(scores, first_order, out.expected);
  std::sort(scores.contrasts.begin(), scores.contrasts.end());
  out.seen.contrast_p05 = scores.contrasts[static_cast<std::size_t>(0.05 * (out.prints - 1))];
}

/// Explains why there is no print tolerance analysis of the panel. Empty if there is one.
std::string unevaluated(const DisplayFile& file, const Run& run) {
  if (!file.goal.is_binary()) return "the analysis covers only pictures of two levels";
  if (!run.equilibrium->reached()) return "the panel did not reach its equilibrium";
  if (run.equilibrium->path.let_go > 0)
    return "the analysis needs every body that the plates press on to stay at its plate";
  if (run.design.structure.cells() > max_printed_cells)
    return fmt::format("the analysis covers only panels of up to {} cells", max_printed_cells);
  return "";
}

/// Adds the requirements on the picture that prints miss. @param who name of these prints in the text
void add_missing(const DisplayFile& file, const optim::DisplayTolerance& made, const std::string& who,
                 std::vector<std::string>& why) {
  if (made.auc < file.auc)
    why.push_back(
        fmt::format("{} show it with auc {:.3f}, and at least {:g} is required", who, made.auc, file.auc));
  if (made.contrast_p05 < file.contrast)
    why.push_back(fmt::format("95 % of {} have a separation d′ above {:.2f}, and at least {:g} is required",
                              who, made.contrast_p05, file.contrast));
}

std::vector<std::string> reasons(const DisplayFile& file, const Run& run, const PrintedDisplay& printed) {
  std::vector<std::string> why = unprintable(run);
  add_missing(file, printed.expected, "prints", why);
  if (printed.failed > 0)
    why.push_back(fmt::format("{} of {} prints in the elastic model found no equilibrium near the design",
                              printed.failed, printed.prints + printed.failed));
  if (printed.prints > 0)
    add_missing(file, printed.seen, fmt::format("{} prints in the elastic model", printed.prints), why);
  return why;
}

}  // namespace

std::pair<std::optional<PrintedDisplay>, std::string> display_prints(const DisplayFile& file, const Run& run,
                                                                     const RunOptions& options) {
  if (std::string why = unevaluated(file, run); !why.empty()) return {std::nullopt, std::move(why)};
  const model::HingeScatter scatter = scatter_of(run.design);
  const std::vector<double> levels = levels_of(file.goal, run.design.structure);
  model::State state = run.equilibrium->path.state;
  const auto by = derivatives(file, run, scatter, state, static_cast<Eigen::Index>(levels.size()));
  if (!by) return {std::nullopt, "the panel's equilibrium is not stable"};
  const FirstOrderPanel panel{levels, read_panel(file, run.design.structure, state).channel, *by};
  PrintedDisplay out;
  out.expected = optim::analyse_display_tolerance(panel.readings, levels, panel.by_errors);
  add_prints(file, run, scatter, state, panel, options, out);
  out.why = reasons(file, run, out);
  return {std::move(out), ""};
}

}  // namespace kinetix::app
