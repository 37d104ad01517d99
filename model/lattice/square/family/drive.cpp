#include "model/lattice/square/family/drive.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "model/base/invalid_input.hpp"
#include "model/lattice/planar/planar_drive.hpp"
#include "model/lattice/square/family/classify.hpp"
#include "model/lattice/square/family/net_grip.hpp"
#include "model/linkage/make_drive.hpp"

namespace kinetix::model {
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
bool keeps_its_rim_flat(const Classification& kind, const Structure& structure) {
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
    if (!keeps_rows_straight(kind.redrawing, axis, rows)) continue;
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
  if (hinge != structure.hinges.end() && !keeps_its_rim_flat(kind, structure))
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
