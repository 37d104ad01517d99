#include "app/goals/display/larger_panels.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/goals/display/display_limits.hpp"
#include "app/goals/display/search_panel.hpp"
#include "app/pipeline/hinge_loads.hpp"

namespace kinetix::app {
namespace {

// Times as many cells each way: each is a whole search, so that there are few.
constexpr double factors[] = {1.25, 1.5, 2};
// Cells of such a panel, 25 x 25: a limit to the time of searches that the user did not ask for.
constexpr int most_tried = 625;

std::vector<targets::PanelSize> larger_sizes(targets::PanelSize asked) {
  std::vector<targets::PanelSize> sizes;
  for (const double factor : factors) {
    const targets::PanelSize size = {static_cast<int>(std::ceil(factor * asked[0])),
                                     static_cast<int>(std::ceil(factor * asked[1]))};
    if (size[0] * size[1] <= most_tried) sizes.push_back(size);
  }
  return sizes;
}

/// @param file whose goal is drawn on the larger panel
bool shows(const DisplayFile& file, const optim::DisplayOptions& options, const Progress& progress) {
  const targets::PanelSize size = {file.goal.columns, file.goal.rows};
  const model::Sheet panel = make_panel(file, size);
  const auto told = [&](const std::string&, double done, const std::string& so_far) {
    progress(fmt::format("{} x {}", size[0], size[1]), done, so_far);
  };
  const optim::DisplayView view = search_panel(file, file.goal, panel, options, told).view;
  if (!view.at_equilibrium) return false;
  const PanelLoads seen = panel_loads(file, panel, view, options.elasticity);
  targets::DisplayScore score;
  score.auc = seen.auc;
  score.contrast = seen.contrast;
  return share_of(file.limits, seen.hinges) <= 1 && seen.stretch <= file.stretch &&
         violations(file, score, seen.rank, "").empty();
}

}  // namespace

std::vector<std::string> violations(const DisplayFile& file, const targets::DisplayScore& score, double rank,
                                    const std::string& who) {
  std::vector<std::string> why;
  const bool binary = file.goal.is_binary();
  const double told = binary ? score.auc : rank;
  if (!(told >= file.auc))
    why.push_back(fmt::format("{}: {} {:.3f}; at least {:.3f} is required", who,
                              binary ? "auc" : "rank correlation", told, file.auc));
  if (binary && !(score.contrast >= file.contrast))
    why.push_back(
        fmt::format("{}: contrast {:.2f}; at least {:.2f} is required", who, score.contrast, file.contrast));
  return why;
}

LargerPanels search_larger_panels(const DisplayFile& file, const optim::DisplayOptions& options,
                                  const Progress& progress) {
  LargerPanels larger;
  if (!file.goal.redrawn) return larger;
  DisplayFile alike = file;
  alike.driven_hinge.reset();  // of the panel that was asked for
  for (const targets::PanelSize size : larger_sizes({file.goal.columns, file.goal.rows})) {
    const targets::DisplayGoal goal = file.goal.redrawn(size);
    if (!goal.whole || (options.symmetry == optim::Symmetry::rotate_4 && size[0] != size[1])) continue;
    if (options.solver.stop.stop_requested()) break;
    alike.goal = goal;
    const bool shown = shows(alike, options, progress);
    if (!shown && options.solver.stop.stop_requested()) break;  // cut short
    larger.tried.push_back(size);
    if (!shown) continue;
    larger.enough = size;
    break;
  }
  return larger;
}

}  // namespace kinetix::app
