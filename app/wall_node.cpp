#include "app/wall_node.hpp"

namespace kinetix {
namespace {

constexpr int highest_index = 10'000;

Wall read_wall(const Node& owner) {
  const Node node = owner.required("wall", "its two vertices, e.g. `wall: [[0, 0], [1, 0]]`");
  const auto ends = node.list_of(2, "two vertices, e.g. [[0, 0], [1, 0]]");
  const Vertex from = read_vertex(ends[0]), to = read_vertex(ends[1]);
  for (const Axis axis : {Axis::x, Axis::y}) {
    const Wall wall{from, axis};
    if (wall.to() == to) return wall;
    const Wall reversed{to, axis};
    if (reversed.to() == from)
      throw node.error("runs from its upper to its lower vertex; write " + to_string(reversed) +
                       ", and count t, alpha and beta from " + to_string(to));
  }
  throw node.error("vertices " + to_string(from) + " and " + to_string(to) +
                   " are not neighbours; a wall is one step along x or y, e.g. [[0, 0], [1, 0]]");
}

}  // namespace

Vertex read_vertex(const Node& node) {
  const auto ij = node.list_of(2, "a vertex [i, j]");
  return {ij[0].integer(0, highest_index), ij[1].integer(0, highest_index)};
}

int read_hinge_index(const Node& owner, const Structure& structure) {
  const Wall wall = read_wall(owner);
  if (const auto hinge = structure.hinge_at(wall)) return *hinge;
  throw owner.required("wall", "")
      .error("the structure has no wall " + to_string(wall) + "; a wall is a side of one of structure.cells");
}

}  // namespace kinetix
