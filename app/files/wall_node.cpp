#include "app/files/wall_node.hpp"

namespace kinetix::app {
namespace {

constexpr int highest_number = 4'000'000;  // of a vertex in a lattice that numbers them
constexpr int highest_index = 10'000;      // of a vertex: end of the longest side that `cells` allows

model::Wall read_wall(const targets::Node& node) {
  const auto ends = node.list_of(2, "two vertices, e.g. [[0, 0], [1, 0]]");
  const model::Vertex from = read_vertex(ends[0]), to = read_vertex(ends[1]);
  for (const model::Axis axis : {model::Axis::x, model::Axis::y}) {
    const model::Wall wall{from, axis};
    if (wall.to() == to) return wall;
    const model::Wall reversed{to, axis};
    if (reversed.to() == from)
      throw node.error("runs from its upper to its lower vertex; write " + to_string(reversed) +
                       ", and count t, alpha and beta from " + to_string(to));
  }
  throw node.error("vertices " + to_string(from) + " and " + to_string(to) +
                   " are not neighbours; a wall is one step along x or y, e.g. [[0, 0], [1, 0]]");
}

int square_hinge(const targets::Node& node, const model::Structure& structure) {
  const model::Wall wall = read_wall(node);
  if (const auto hinge = structure.hinge_at(wall)) return *hinge;
  throw node.error("the structure has no wall " + to_string(wall) +
                   "; a wall is a side of one of structure.cells");
}

int numbered_hinge(const targets::Node& node, const model::Lattice& sheet,
                   const std::map<std::pair<int, int>, int>& hinge_between) {
  const auto ends = node.list_of(2, "the numbers of two vertices, e.g. [0, 1]");
  const int last = sheet.bodies() - 1, from = ends[0].integer(0, last), to = ends[1].integer(0, last);
  if (const auto hinge = hinge_between.find({from, to}); hinge != hinge_between.end()) return hinge->second;
  if (const auto hinge = hinge_between.find({to, from}); hinge != hinge_between.end())
    throw node.error("runs the other way; write " + wall_name(sheet, hinge->second) +
                     ", and count t, alpha, beta and the offset from vertex " + std::to_string(to));
  throw node.error("no wall joins vertices " + std::to_string(from) + " and " + std::to_string(to));
}

}  // namespace

targets::ValueType vertex_type() {
  return targets::value::list(targets::value::integer(0, highest_index), "`[i, j]`", 2, 2);
}

targets::Key wall_key(std::string with, targets::Default fallback) {
  return {
      "wall",
      targets::value::either(
          {targets::value::list(vertex_type(), "`[[i, j], [i, j]]`", 2, 2),
           targets::value::list(targets::value::integer(0, highest_number), "`[number, number]`", 2, 2)}),
      std::move(fallback),
      "the wall: of squares its lower or left vertex, then the next one along x or y; of other lattices the "
      "numbers of its two vertices, as in result.json",
      std::move(with)};
}

model::Vertex read_vertex(const targets::Node& node) {
  const auto ij = node.list_of(2, "a vertex [i, j]");
  return {ij[0].integer(0, highest_index), ij[1].integer(0, highest_index)};
}

WallReader::WallReader(const model::Lattice& sheet) : sheet_(sheet) {
  if (sheet.squares()) return;
  for (int h = 0; h < sheet.hinges(); ++h) {
    const model::HingedWall wall = sheet.wall(h);
    hinge_between_.emplace(std::pair(wall.lower, wall.upper), h);
  }
}

int WallReader::hinge_of(const targets::Node& wall) const {
  return sheet_.squares() ? square_hinge(wall, *sheet_.squares())
                          : numbered_hinge(wall, sheet_, hinge_between_);
}

int WallReader::hinge_of(const targets::Section& owner) const {
  return hinge_of(owner.required("wall", sheet_.squares()
                                             ? "its two vertices, e.g. `wall: [[0, 0], [1, 0]]`"
                                             : "the numbers of its two vertices, e.g. `wall: [0, 1]`"));
}

}  // namespace kinetix::app
