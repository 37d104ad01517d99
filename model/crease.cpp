#include "model/crease.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace kinetix {
namespace {

int root_of(std::vector<int>& parent, int k) {
  while (parent[k] != k) k = parent[k] = parent[parent[k]];
  return k;
}

/// Joins to the lower index, so that roots come in the order of first hinges.
void join(std::vector<int>& parent, int a, int b) {
  a = root_of(parent, a);
  b = root_of(parent, b);
  parent[std::max(a, b)] = std::min(a, b);
}

}  // namespace

Creases find_creases(const Structure& structure) {
  const int count = static_cast<int>(structure.hinges.size());
  std::vector<int> parent(count);
  std::iota(parent.begin(), parent.end(), 0);
  for (const CellHinges& cell : structure.cell_members) {
    join(parent, cell.hinges[0], cell.hinges[2]);
    join(parent, cell.hinges[1], cell.hinges[3]);
  }
  Creases creases;
  creases.of_hinge.resize(count);
  for (int k = 0; k < count; ++k) {
    const int root = root_of(parent, k);
    if (root == k) {
      creases.of_hinge[k] = static_cast<int>(creases.list.size());
      creases.list.push_back({structure.hinges[k].wall.axis, {}});
    }
    creases.of_hinge[k] = creases.of_hinge[root];
    creases.list[creases.of_hinge[k]].hinges.push_back(k);
  }
  return creases;
}

int alternation(const Wall& wall) {
  const int line = wall.axis == Axis::x ? wall.from.j : wall.from.i;
  return (line & 1) == 0 ? 1 : -1;
}

int turn_sense(const Wall& wall) { return wall.from.sense() * alternation(wall); }

void set_tilt(Structure& structure, const Crease& crease, double tilt) {
  for (const int h : crease.hinges) {
    Hinge& hinge = structure.hinges[h];
    hinge.parameters = {0.5, pi / 2, alternation(hinge.wall) * tilt};
  }
}

double crease_turn(double tilt, double theta) { return 2 * std::atan(std::tan(tilt) * std::sin(theta)); }

double tilt_of_turn(double turn, double theta) { return std::atan(std::tan(turn / 2) / std::sin(theta)); }

}  // namespace kinetix
