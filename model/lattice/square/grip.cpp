#include "model/lattice/square/grip.hpp"

#include <algorithm>

#include "model/base/invalid_input.hpp"

namespace kinetix::model {
namespace {

/// Returns the whole structure's first and last row.
Grip whole_grip(const Structure& structure) {
  Grip all{structure.bodies.front(), structure.bodies.front()};
  for (const Vertex v : structure.bodies) {
    all.first = {std::min(all.first.i, v.i), std::min(all.first.j, v.j)};
    all.last = {std::max(all.last.i, v.i), std::max(all.last.j, v.j)};
  }
  return all;
}

void require_vertex(Vertex v, const Grip& grip, const Structure& structure) {
  if (structure.body_at(v)) return;
  throw InvalidInput("plates cannot grip " + to_string(grip) + ": the structure has no vertex " +
                     to_string(v) + "; their first and last row of vertices must be there");
}

}  // namespace

std::string to_string(const Grip& grip) {
  return "[" + to_string(grip.first) + ", " + to_string(grip.last) + "]";
}

void validate(const Grip& grip, Axis axis, const Structure& structure) {
  if (!(grip.first.i < grip.last.i && grip.first.j < grip.last.j))
    throw InvalidInput("the rectangle " + to_string(grip) +
                       " must span at least one cell both ways: its lower left vertex, then its upper right");
  const bool along_x = axis == Axis::x;
  const int begin = along_x ? grip.first.j : grip.first.i, end = along_x ? grip.last.j : grip.last.i;
  for (int k = begin; k <= end; ++k) {
    require_vertex(along_x ? Vertex{grip.first.i, k} : Vertex{k, grip.first.j}, grip, structure);
    require_vertex(along_x ? Vertex{grip.last.i, k} : Vertex{k, grip.last.j}, grip, structure);
  }
}

GrippedRows gripped_bodies(const Structure& structure, Axis axis, const std::optional<Grip>& grip) {
  const Grip held = grip.value_or(whole_grip(structure));
  GrippedRows rows;
  for (int b = 0; b < static_cast<int>(structure.bodies.size()); ++b) {
    const Vertex v = structure.bodies[b];
    if (!held.contains(v)) continue;
    if (row_along(axis, v) == row_along(axis, held.first)) rows[0].push_back(b);
    if (row_along(axis, v) == row_along(axis, held.last)) rows[1].push_back(b);
  }
  return rows;
}

}  // namespace kinetix::model
