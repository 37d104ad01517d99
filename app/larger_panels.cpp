#include "app/larger_panels.hpp"

#include <fmt/format.h>

#include <cmath>

namespace kinetix {
namespace {

constexpr double factors[] = {1.25, 1.5, 2};
constexpr int most_cells = 625;

std::vector<PanelSize> larger_sizes(PanelSize asked) {
  std::vector<PanelSize> sizes;
  for (const double factor : factors) {
    const PanelSize size = {static_cast<int>(std::ceil(factor * asked[0])),
                            static_cast<int>(std::ceil(factor * asked[1]))};
    if (size[0] * size[1] <= most_cells) sizes.push_back(size);
  }
  return sizes;
}

bool shows(const DisplayFile& file, const DisplayGoal& goal, const DisplayOptions& options,
           const std::function<void(const std::string&, double)>& progress) {
  const PanelSize size = {goal.columns, goal.rows};
  const Structure panel = make_structure(rectangle(size[0], size[1]), file.size);
  const auto told = [&](const std::string&, double done) {
    if (progress) progress(fmt::format("{} x {}", size[0], size[1]), done);
  };
  const DisplayView view = fit_display(panel, levels_of(goal, panel), options, told).view;
  return view.balanced && view.stretch <= file.stretch && misses(file, view.score, view.rank, "").empty();
}

}  // namespace

std::vector<double> levels_of(const DisplayGoal& goal, const Structure& panel) {
  std::vector<double> levels;
  for (const Cell& cell : panel.cells) levels.push_back(goal.level(cell.i, cell.j));
  return levels;
}

std::vector<std::string> misses(const DisplayFile& file, const DisplayScore& score, double rank,
                                const std::string& who) {
  std::vector<std::string> why;
  const bool binary = file.goal.is_binary();
  const double told = binary ? score.auc : rank;
  if (!(told >= file.auc))
    why.push_back(fmt::format("{}: {} {:.3f}, asked is {:.3f}", who, binary ? "auc" : "rank correlation",
                              told, file.auc));
  if (binary && !(score.contrast >= file.contrast))
    why.push_back(fmt::format("{}: contrast {:.2f}, asked is {:.2f}", who, score.contrast, file.contrast));
  return why;
}

LargerPanels search_larger_panels(const DisplayFile& file, const DisplayOptions& options,
                                  const std::function<void(const std::string&, double)>& progress) {
  LargerPanels larger;
  if (!file.goal.redrawn) return larger;
  for (const PanelSize size : larger_sizes({file.goal.columns, file.goal.rows})) {
    const DisplayGoal goal = file.goal.redrawn(size);
    if (!goal.whole || (options.symmetry == Symmetry::rotate_4 && size[0] != size[1])) continue;
    larger.tried.push_back(size);
    if (!shows(file, goal, options, progress)) continue;
    larger.enough = size;
    break;
  }
  return larger;
}

}  // namespace kinetix
