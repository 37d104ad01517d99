#include "model/lattice/square/family/drive.hpp"

#include <limits>
#include <set>
#include <tuple>

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
                     to_string(v) + ". Give a grip with its first and last row of vertices");
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

namespace {

using Cells = std::set<Cell>;

bool is_at_wall_middle(const HingeParameters& p) { return std::abs(p.t - 0.5) <= 1e-9; }

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
  const auto is_basic = [](const Hinge& h) { return is_at_wall_middle(h.parameters) && is_vertical(h); };
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
    return is_at_wall_middle(h.parameters) && (h.wall.axis != axis || is_vertical(h));
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
  throw InvalidInput(
      "plates normal to " + std::string(to_string(axis)) + " cannot hold the boundary of " + what +
          ": as it folds, its first and last row of vertices do not stay in two parallel planes at the flat "
          "distance times the cosine of the fold angle; "
          "grip a flat panel, or a spine by its two long sides",
      {"", 0, 0, "drive.grip"});
}

namespace {

bool is_half(double t) { return std::abs(t - 0.5) <= 1e-9; }

bool is_rectangle(const Structure& structure) {
  const Cell first = structure.cells.front(), last = structure.cells.back();
  const long columns = last.i - first.i + 1, rows = last.j - first.j + 1;
  const bool fits = std::all_of(structure.cells.begin(), structure.cells.end(),
                                [&](Cell c) { return first.j <= c.j && c.j <= last.j; });
  return fits && static_cast<long>(structure.cells.size()) == columns * rows;
}

/// Returns true if the pins that keep the plates from tipping a sheet are on one line across it. Where the sheet
/// bends, other pins would leave the plane z = 0.
bool pins_face_each_other(const Structure& structure, Axis axis) {
  const GrippedRows rows = gripped_bodies(structure, axis);
  const auto place = [&](const std::vector<int>& row) {
    return row_along(axis == Axis::x ? Axis::y : Axis::x, structure.bodies[row[row.size() / 2]]);
  };
  return place(rows[0]) == place(rows[1]);
}

/// Returns true if the rows of vertices along the boundary stay straight lines or plane curves while the sheet folds.
bool keeps_boundary_flat(const Classification& kind, const Structure& structure) {
  if (kind.family == Family::none) return is_rectangle(structure);
  if (kind.family == Family::planar) return false;
  if (kind.family != Family::F1 && !pins_face_each_other(structure, kind.transposed ? Axis::x : Axis::y))
    return false;
  return std::all_of(kind.design.t.begin(), kind.design.t.end(), is_half);
}

Plates plates_to(Axis axis, double theta) {
  // 1 - cos(theta) without its rounding
  return {.axis = axis, .compression = 2 * std::pow(std::sin(theta / 2), 2), .branch = theta < 0 ? -1 : 1};
}

/// Returns plates whose rows stay straight, parallel and closer than flat; along y if both directions have them.
std::optional<Plates> planar_plates(const Structure& structure, const Classification& kind, double theta) {
  const State state = fold(kind, structure, theta);
  for (const Axis axis : {Axis::y, Axis::x}) {
    const GrippedRows rows = gripped_bodies(structure, axis);
    if (!keeps_rows_straight(kind.parallel_drawing, axis, rows)) continue;
    const int d = component(axis);
    const auto distance = [&](const auto& place) { return place(rows[1].front()) - place(rows[0].front()); };
    const double rest = distance([&](int b) { return structure.rest_position(b)[d]; });
    Plates drive = plates_to(axis, theta);
    drive.compression = 1 - distance([&](int b) { return state[b].p[d]; }) / rest;
    if (drive.compression >= 0) return drive;
  }
  return std::nullopt;
}

std::vector<int> bodies_within(const Structure& structure, const std::optional<Grip>& grip) {
  std::vector<int> held;
  for (int b = 0; b < static_cast<int>(structure.bodies.size()); ++b)
    if (!grip || grip->contains(structure.bodies[b])) held.push_back(b);
  return held;
}

Eigen::Vector3d middle_of(const Structure& structure) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const int count = static_cast<int>(structure.bodies.size());
  for (int b = 0; b < count; ++b) sum += structure.rest_position(b);
  return sum / count;
}

/// Returns the hinge nearest to the middle among those that turn by 2 theta. Without any, it is the nearest vertical
/// hinge, or the nearest of all.
HingeTurn middle_hinge_drive(const Structure& structure, const NetTree& tree, double theta) {
  const Eigen::Vector3d middle = middle_of(structure);
  const std::vector<double> shifts = fold_shifts(tree.angles, structure);
  const std::vector<int> crease = find_creases(structure).of_hinge;
  const auto rank = [&](int h) {
    const Hinge& hinge = structure.hinges[h];
    return std::tuple(!is_vertical(hinge), shifts[crease[h]] != 0,
                      (structure.rest_position(hinge.lower) - middle).squaredNorm());
  };
  int best = 0;
  for (int h = 1; h < static_cast<int>(structure.hinges.size()); ++h)
    if (rank(h) < rank(best)) best = h;
  const Hinge& hinge = structure.hinges[best];
  const double own = fold_angle(theta, shifts[crease[best]]).value;
  return hinge_drive_to(structure, hinge.wall,
                        is_vertical(hinge) ? own : half_turn(hinge.parameters.beta, own));
}

Drive net_drive(const Structure& structure, const Classification& kind, double theta) {
  const auto fold_to = [&](double at) { return fold(kind, structure, at); };
  if (const auto part = find_net_grip(structure)) {
    Plates drive = plates_to(part->axis, theta);
    drive.grip = part->grip;
    if (keeps_between_plates(structure, gripped_bodies(structure, drive.axis, drive.grip), fold_to))
      return drive;
  }
  return middle_hinge_drive(structure, kind.tree, theta);
}

}  // namespace

Drive drive_to(const Structure& structure, double theta) {
  if (!(std::abs(theta) < pi / 2))
    throw InvalidInput("theta is " + number_text(theta) + " rad, must be in (-pi/2, pi/2)");
  const Classification kind = classify(structure);
  if (kind.family == Family::F4) return net_drive(structure, kind, theta);
  if (kind.family == Family::planar)
    if (const auto plates = planar_plates(structure, kind, theta)) return *plates;
  const auto hinge = std::find_if(structure.hinges.begin(), structure.hinges.end(),
                                  [](const Hinge& h) { return is_vertical(h); });
  if (hinge != structure.hinges.end() && !keeps_boundary_flat(kind, structure))
    return hinge_drive_to(structure, hinge->wall, theta);
  return plates_to(kind.transposed ? Axis::x : Axis::y, theta);
}

LinkageDrive plate_drive(const Structure& structure, Axis axis, double compression, int branch,
                         const std::optional<Grip>& grip) {
  if (grip) validate(*grip, axis, structure);
  validate_hinges(structure);
  LinkageDrive out = plates_between(gripped_bodies(structure, axis, grip), axis, compression, branch,
                                    static_cast<int>(structure.bodies.size()));
  out.grips_part = grip.has_value();
  out.held = bodies_within(structure, grip);
  return out;
}

LinkageDrive hinge_drive(const Structure& structure, int hinge, double angle) {
  validate_hinges(structure);
  return turned_hinge(hinge, structure.hinges.at(hinge).wall.from.sense(), angle);
}

HingeTurn hinge_drive_to(const Structure& structure, const Wall& wall, double theta) {
  if (const auto hinge = structure.hinge_at(wall)) return {*hinge, turn_at_theta(wall.from.sense(), theta)};
  throw InvalidInput("drive.wall " + to_string(wall) + " is not a wall of the structure");
}

std::vector<Drive> search_drives(const Structure& structure, double theta) {
  const auto upright = std::find_if(structure.hinges.begin(), structure.hinges.end(),
                                    [](const Hinge& hinge) { return is_vertical(hinge); });
  const Wall wall = (upright == structure.hinges.end() ? structure.hinges.begin() : upright)->wall;
  return {hinge_drive_to(structure, wall, theta), hinge_drive_to(structure, wall, -theta)};
}

}  // namespace kinetix::model
