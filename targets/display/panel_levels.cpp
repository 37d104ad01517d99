#include "targets/display/panel_levels.hpp"

namespace kinetix::targets {

std::vector<double> levels_of(const DisplayGoal& goal, const model::Structure& panel) {
  std::vector<double> levels;
  for (const model::Cell& cell : panel.cells) levels.push_back(goal.level(cell.i, cell.j));
  return levels;
}

}  // namespace kinetix::targets
