#include "app/goals/display/display_prints.hpp"

#include <algorithm>
#include <cmath>

#include "app/goals/display/search_panel.hpp"
#include "app/pipeline/as_made.hpp"
#include "model/elastic/newton.hpp"
#include "targets/display/panel_levels.hpp"

namespace kinetix::app {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Beyond, the derivatives of all cells take longer than the search.
constexpr int most_cells = 400;

/// Readings of all cells by every hinge's t, alpha, beta and offset, times its standard deviation.
std::optional<MatrixXd> rates(const DisplayFile& file, const Run& run, const model::HingeScatter& scatter,
                              model::State& state, std::vector<double>& readings, Eigen::Index cells) {
  const Equilibrium& equilibrium = *run.equilibrium;
  const double theta = equilibrium.path.theta;
  model::ElasticSystem system(run.structure, equilibrium.elasticity, equilibrium.drive, true, true);
  system.set_multiplier(equilibrium.path.multiplier);
  model::TangentStiffness tangent(system.dofs());
  if (!settle(system, theta, state, tangent)) return std::nullopt;
  const model::Linkage panel(run.structure);
  const optim::SmoothChannel channel(file.channel, panel, state);
  readings = channel.values();
  MatrixXd out(cells, 4 * run.structure.hinges());
  for (Eigen::Index k = 0; k < cells; ++k) {
    model::PanelSlopes slopes(run.structure);
    channel.add_slopes(VectorXd::Unit(static_cast<Eigen::Index>(readings.size()), k), slopes);
    model::EquilibriumGradient gradient;
    gradient.state = slopes.state;
    Eigen::Matrix4Xd by = sensitivity(system, equilibrium.elasticity, state, theta, tangent, gradient).hinges;
    by.row(0) += slopes.t.transpose();
    by.row(3) += slopes.offset.transpose();
    by = scatter.values().asDiagonal() * by;
    out.row(k) = by.reshaped().transpose();
  }
  return out;
}

/// Contrast and auc of prints, one after the other.
void add_prints(const DisplayFile& file, const Run& run, const model::HingeScatter& scatter,
                const model::State& state, int count, PrintedDisplay& out) {
  std::vector<double> contrasts;
  double auc = 0;
  const auto seen = [&](const model::State&, const model::State& print, const Eigen::Matrix4Xd& errors) {
    const targets::DisplayScore score = read_panel(file, printed_sheet(run.structure, errors), print).score;
    contrasts.push_back(score.contrast);
    auc += score.auc;
  };
  out.failed = visit_prints(
      [&](const Eigen::Matrix4Xd& errors) { return printed_sheet(run.structure, errors); },
      run.equilibrium->elasticity, run.equilibrium->drive, state, scatter, count, {.planar = true}, seen);
  out.prints = static_cast<int>(contrasts.size());
  if (contrasts.empty()) return;
  std::sort(contrasts.begin(), contrasts.end());
  for (const double contrast : contrasts) out.seen.contrast += contrast / out.prints;
  out.seen.contrast_p95 = contrasts[static_cast<std::size_t>(0.05 * (out.prints - 1))];
  out.seen.auc = auc / out.prints;
}

}  // namespace

std::optional<PrintedDisplay> display_prints(const DisplayFile& file, const Run& run, int prints) {
  if (!file.goal.is_binary() || !run.equilibrium->reached() || run.structure.cells() > most_cells)
    return std::nullopt;
  const model::HingeScatter scatter = scatter_of(run);
  const std::vector<double> levels = levels_of(file.goal, run.structure);
  model::State state = run.equilibrium->path.state;
  std::vector<double> readings;
  const auto by = rates(file, run, scatter, state, readings, static_cast<Eigen::Index>(levels.size()));
  if (!by) return std::nullopt;
  PrintedDisplay out;
  out.expected = optim::as_made_display(readings, levels, *by);
  add_prints(file, run, scatter, state, std::max(prints, least_prints), out);
  return out;
}

}  // namespace kinetix::app
