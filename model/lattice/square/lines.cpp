#include "model/lattice/square/lines.hpp"

#include <algorithm>

namespace kinetix::model {

int line_of(const Wall& wall) { return row_along(wall.axis, wall.from); }

int line_count(const Structure& structure, Axis axis) {
  int count = 0;
  for (const Hinge& h : structure.hinges)
    if (h.wall.axis == axis) count = std::max(count, line_of(h.wall) + 1);
  return count;
}

std::vector<int> hinges_on_line(const Structure& structure, Axis axis, int line) {
  std::vector<int> hinges;
  for (int k = 0; k < static_cast<int>(structure.hinges.size()); ++k) {
    const Wall& wall = structure.hinges[k].wall;
    if (wall.axis == axis && line_of(wall) == line) hinges.push_back(k);
  }
  return hinges;
}

bool starts_in_class_b(const Wall& wall) { return !wall.from.is_class_a(); }

std::vector<std::vector<int>> body_columns(const Structure& structure) {
  std::vector<std::vector<int>> columns;
  for (int b = 0; b < static_cast<int>(structure.bodies.size()); ++b) {
    if (b == 0 || structure.bodies[b].i != structure.bodies[b - 1].i) columns.emplace_back();
    columns.back().push_back(b);
  }
  return columns;
}

}  // namespace kinetix::model
