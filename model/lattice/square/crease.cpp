#include "model/lattice/square/crease.hpp"

#include "model/base/algorithms.hpp"

namespace kinetix::model {

Creases find_creases(const Structure& structure) {
  const int count = static_cast<int>(structure.hinges.size());
  UnionFind same(structure.hinges.size());
  for (const CellHinges& cell : structure.cell_members) {
    same.unite(cell.hinges[0], cell.hinges[2]);
    same.unite(cell.hinges[1], cell.hinges[3]);
  }
  Creases creases;
  creases.of_hinge.resize(count);
  for (int k = 0; k < count; ++k) {
    const int root = same.find(k);
    if (root == k) {
      creases.of_hinge[k] = static_cast<int>(creases.list.size());
      creases.list.push_back({structure.hinges[k].wall.axis, {}});
    }
    creases.of_hinge[k] = creases.of_hinge[root];
    creases.list[creases.of_hinge[k]].hinges.push_back(k);
  }
  return creases;
}

int line_of(const Structure& structure, const Crease& crease) {
  return row_along(crease.axis, structure.hinges[crease.hinges[0]].wall.from);
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

}  // namespace kinetix::model
