#include "targets/display/panel_levels.hpp"

namespace kinetix::targets {

std::vector<double> levels_of(const DisplayGoal& goal, const model::Lattice& panel) {
  std::vector<double> levels;
  for (int c = 0; c < panel.cells(); ++c)
    if (const std::vector<int> at = cell_label(panel, c); at.size() == 2)
      levels.push_back(goal.level(at[0], at[1]));
  return levels;
}

std::vector<double> in_order_of_goal(const DisplayGoal& goal, const model::Lattice& panel,
                                     const std::vector<double>& values) {
  std::vector<double> out(goal.levels.size());
  std::size_t next = 0;
  for (int c = 0; c < panel.cells(); ++c)
    if (const std::vector<int> at = cell_label(panel, c); at.size() == 2)
      out[static_cast<std::size_t>(at[1]) * goal.columns + at[0]] = values[next++];
  return out;
}

}  // namespace kinetix::targets
