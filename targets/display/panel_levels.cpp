#include "targets/display/panel_levels.hpp"

namespace kinetix::targets {

std::vector<double> levels_of(const DisplayGoal& goal, const model::Sheet& panel) {
  std::vector<double> levels;
  for (int c = 0; c < panel.cells(); ++c)
    if (const std::vector<int> at = cell_label(panel, c); at.size() == 2)
      levels.push_back(goal.level(at[0], at[1]));
  return levels;
}

}  // namespace kinetix::targets
