#include "model/lattice/square/family/net_grip.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "model/base/invalid_input.hpp"

namespace kinetix::model {
namespace {

using Cells = std::set<Cell>;

bool halves_its_wall(const HingeParameters& p) { return std::abs(p.t - 0.5) <= 1e-9; }

/// Returns the cells with only suitable walls.
template <class Suits>
Cells cells_where(const Structure& structure, const Suits& suits_hinge) {
  const auto suits = [&](int hinge) { return suits_hinge(structure.hinges[hinge]); };
  Cells cells;
  for (std::size_t c = 0; c < structure.cells.size(); ++c) {
    const auto& hinges = structure.cell_members[c].hinges;
    if (std::all_of(hinges.begin(), hinges.end(), suits)) cells.insert(structure.cells[c]);
  }
  return cells;
}

bool holds_row(const Cells& cells, int begin, int end, int j) {
  for (int i = begin; i < end; ++i)
    if (!cells.contains({i, j})) return false;
  return true;
}

bool holds_column(const Cells& cells, int i, int begin, int end) {
  for (int j = begin; j < end; ++j)
    if (!cells.contains({i, j})) return false;
  return true;
}

/// Returns the rectangles of cells that no larger one contains.
std::vector<Grip> largest_rectangles(const Cells& cells) {
  std::vector<Grip> all;
  for (const auto& [i, j] : cells) {
    int end = std::numeric_limits<int>::max();
    for (int top = j; cells.contains({i, top}); ++top) {
      int reach = i;
      while (reach < end && cells.contains({reach, top})) ++reach;
      end = reach;
      if (holds_row(cells, i, end, top + 1) || holds_row(cells, i, end, j - 1)) continue;
      if (!holds_column(cells, i - 1, j, top + 1)) all.push_back({{i, j}, {end, top + 1}});
    }
  }
  return all;
}

std::vector<NetGrip> flat_panels(const Structure& structure) {
  std::vector<NetGrip> panels;
  const auto is_basic = [](const Hinge& h) { return halves_its_wall(h.parameters) && is_vertical(h); };
  for (const Grip& grip : largest_rectangles(cells_where(structure, is_basic))) {
    const bool is_long_in_y = grip.last.j - grip.first.j > grip.last.i - grip.first.i;
    panels.push_back({grip, is_long_in_y ? Axis::x : Axis::y});
  }
  return panels;
}

/// Returns the spines between plates normal to the axis.
std::vector<NetGrip> spines(const Structure& structure, Axis axis) {
  std::vector<NetGrip> all;
  const auto suits = [&](const Hinge& h) {
    return halves_its_wall(h.parameters) && (h.wall.axis != axis || is_vertical(h));
  };
  for (const Grip& grip : largest_rectangles(cells_where(structure, suits)))
    if (row_along(axis, grip.last) - row_along(axis, grip.first) == 1) all.push_back({grip, axis});
  return all;
}

std::vector<NetGrip> parts_to_grip(const Structure& structure) {
  std::vector<NetGrip> all = flat_panels(structure);
  for (const Axis axis : {Axis::y, Axis::x})
    for (const NetGrip& spine : spines(structure, axis)) all.push_back(spine);
  return all;
}

using AdjacentBodies = std::vector<std::vector<int>>;

AdjacentBodies adjacent_bodies(const Structure& structure) {
  AdjacentBodies near(structure.bodies.size());
  for (const Hinge& hinge : structure.hinges) {
    near[hinge.lower].push_back(hinge.upper);
    near[hinge.upper].push_back(hinge.lower);
  }
  return near;
}

/// Returns the sum over the bodies of the number of walls to the nearest body in the grip.
long distance_to(const Grip& grip, const Structure& structure, const AdjacentBodies& near) {
  std::vector<int> walls(near.size(), -1), queue;
  const auto reach = [&](int body, int distance) {
    walls[body] = distance;
    queue.push_back(body);
  };
  for (int b = 0; b < static_cast<int>(near.size()); ++b)
    if (grip.contains(structure.bodies[b])) reach(b, 0);
  long sum = 0;
  for (std::size_t k = 0; k < queue.size(); ++k) {
    const int body = queue[k];
    sum += walls[body];
    for (const int next : near[body])
      if (walls[next] < 0) reach(next, walls[body] + 1);
  }
  return sum;
}

}  // namespace

std::optional<NetGrip> find_net_grip(const Structure& structure) {
  std::optional<NetGrip> best;
  const AdjacentBodies near = adjacent_bodies(structure);
  long least = std::numeric_limits<long>::max();
  for (const NetGrip& part : parts_to_grip(structure)) {
    const long distance = distance_to(part.grip, structure, near);
    if (!(distance < least)) continue;
    least = distance;
    best = part;
  }
  return best;
}

void require_kept_rows(const Structure& structure, const Classification& kind, Axis axis,
                       const std::optional<Grip>& grip) {
  require_kept_rows(structure, kind, axis, gripped_bodies(structure, axis, grip),
                    grip ? to_string(*grip) : "this net");
}

void require_kept_rows(const Structure& structure, const Classification& kind, Axis axis,
                       const GrippedRows& rows, const std::string& what) {
  if (kind.family == Family::none) return;
  const auto fold_to = [&](double theta) { return fold(kind, structure, theta); };
  if (keeps_between_plates(structure, rows, fold_to)) return;
  throw InvalidInput("plates normal to " + std::string(to_string(axis)) + " cannot hold the rim of " + what +
                         ": its first and last row of vertices do not stay in two parallel planes, "
                         "cos(theta) times as far apart as "
                         "flat, as it folds; "
                         "grip a flat panel, or a spine by its two long sides",
                     {"", 0, 0, "drive.grip"});
}

}  // namespace kinetix::model
