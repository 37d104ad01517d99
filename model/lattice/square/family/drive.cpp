#include "model/lattice/square/family/drive.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "model/base/invalid_input.hpp"
#include "model/lattice/planar/planar_drive.hpp"
#include "model/lattice/square/family/classify.hpp"
#include "model/lattice/square/family/net_grip.hpp"

namespace kinetix::model {
namespace {

void validate_plates(const Drive& drive, const Structure& structure) {
  if (!(drive.compression >= 0 && drive.compression < 1))
    throw InvalidInput("drive.compression is " + number_text(drive.compression) + ", must be in [0, 1)");
  if (drive.branch != 1 && drive.branch != -1)
    throw InvalidInput("drive.branch is " + std::to_string(drive.branch) + ", must be 1 or -1");
  if (drive.grip) validate(*drive.grip, drive.axis, structure);
}

void validate_hinge(const Drive& drive, const Structure& structure) {
  if (!(std::abs(drive.angle) < pi))
    throw InvalidInput("drive.angle is " + number_text(drive.angle) + " rad, must be in (-pi, pi)");
  if (structure.hinge_at(drive.wall)) return;
  throw InvalidInput("drive.wall " + to_string(drive.wall) + " is not a wall of the structure");
}

bool is_half(double t) { return std::abs(t - 0.5) <= 1e-9; }

bool is_rectangle(const Structure& structure) {
  const Cell first = structure.cells.front(), last = structure.cells.back();
  const long columns = last.i - first.i + 1, rows = last.j - first.j + 1;
  const bool fits = std::all_of(structure.cells.begin(), structure.cells.end(),
                                [&](Cell c) { return first.j <= c.j && c.j <= last.j; });
  return fits && static_cast<long>(structure.cells.size()) == columns * rows;
}

/// Whether the pins that keep the plates from tipping a sheet are on one line across it: where it bends,
/// others would leave the plane z = 0.
bool pins_face_each_other(const Structure& structure, Axis axis) {
  const GrippedRows rows = gripped_bodies(structure, axis);
  const auto place = [&](const std::vector<int>& row) {
    return row_along(axis == Axis::x ? Axis::y : Axis::x, structure.bodies[row[row.size() / 2]]);
  };
  return place(rows[0]) == place(rows[1]);
}

/// Whether the rows of vertices along the rim stay straight lines or plane curves while the sheet folds.
bool keeps_its_rim_flat(const Classification& kind, const Structure& structure) {
  if (kind.family == Family::none) return is_rectangle(structure);
  if (kind.family == Family::planar) return false;
  if (kind.family != Family::F1 && !pins_face_each_other(structure, kind.transposed ? Axis::x : Axis::y))
    return false;
  return std::all_of(kind.design.t.begin(), kind.design.t.end(), is_half);
}

Drive plate_drive(Axis axis, double theta) {
  Drive drive;
  drive.axis = axis;
  drive.compression = 2 * std::pow(std::sin(theta / 2), 2);  // 1 - cos(theta) without its rounding
  drive.branch = theta < 0 ? -1 : 1;
  return drive;
}

/// Plates whose rows stay straight, parallel and closer than flat; along y if both directions have them.
std::optional<Drive> planar_plates(const Structure& structure, const Classification& kind, double theta) {
  const State state = fold(kind, structure, theta);
  for (const Axis axis : {Axis::y, Axis::x}) {
    const GrippedRows rows = gripped_bodies(structure, axis);
    if (!keeps_rows_straight(kind.redrawing, axis, rows)) continue;
    const int d = component(axis);
    const auto distance = [&](const auto& place) { return place(rows[1].front()) - place(rows[0].front()); };
    const double rest = distance([&](int b) { return structure.rest_position(b)[d]; });
    Drive drive = plate_drive(axis, theta);
    drive.compression = 1 - distance([&](int b) { return state[b].p[d]; }) / rest;
    if (drive.compression >= 0) return drive;
  }
  return std::nullopt;
}

/// @param half_turn of its hinge: theta where it is vertical
Drive hinge_drive(const Wall& wall, double half_turn) { return hinge_drive_to(wall, half_turn); }

std::vector<int> bodies_within(const Structure& structure, const std::optional<Grip>& grip) {
  std::vector<int> held;
  for (int b = 0; b < static_cast<int>(structure.bodies.size()); ++b)
    if (!grip || grip->contains(structure.bodies[b])) held.push_back(b);
  return held;
}

/// All but the bodies and hinges that it drives.
LinkageDrive settings_of(const Drive& drive) {
  LinkageDrive out;
  out.kind = drive.kind;
  out.axis = drive.axis;
  out.compression = drive.compression;
  out.branch = drive.branch;
  out.press = drive.press;
  out.sense = drive.wall.from.sense();
  out.angle = drive.angle;
  return out;
}

Eigen::Vector3d middle_of(const Structure& structure) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const int count = static_cast<int>(structure.bodies.size());
  for (int b = 0; b < count; ++b) sum += structure.rest_position(b);
  return sum / count;
}

/// The one nearest to the middle of those that turn by 2 theta; of the vertical ones, or of all, where there
/// is none.
Drive middle_hinge_drive(const Structure& structure, const NetTree& tree, double theta) {
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
  return hinge_drive(hinge.wall, is_vertical(hinge) ? own : half_turn(hinge.parameters.beta, own));
}

Drive net_drive(const Structure& structure, const Classification& kind, double theta) {
  const auto fold_to = [&](double at) { return fold(kind, structure, at); };
  if (const auto part = find_net_grip(structure)) {
    Drive drive = plate_drive(part->axis, theta);
    drive.grip = part->grip;
    if (keeps_between_plates(structure, gripped_bodies(structure, drive.axis, drive.grip), fold_to))
      return drive;
  }
  return middle_hinge_drive(structure, kind.tree, theta);
}

}  // namespace

double Drive::theta() const { return settings_of(*this).theta(); }

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
    return hinge_drive(hinge->wall, theta);
  return plate_drive(kind.transposed ? Axis::x : Axis::y, theta);
}

void validate(const Drive& drive, const Structure& structure) {
  if (drive.kind == Drive::Kind::plates) return validate_plates(drive, structure);
  validate_hinge(drive, structure);
}

LinkageDrive Drive::on(const Structure& structure) const {
  validate(*this, structure);
  validate_hinges(structure);
  LinkageDrive out = settings_of(*this);
  if (kind == Kind::hinge) {
    out.hinge = *structure.hinge_at(wall);
    return out;
  }
  out.gripped = gripped_bodies(structure, axis, grip);
  out.grips_part = grip.has_value();
  out.held = bodies_within(structure, grip);
  return out;
}

DrivenLinkage driven(const Structure& structure, const Drive& drive) {
  return {structure, drive.on(structure), exact_motion(structure)};
}

std::vector<DrivenLinkage> driven(const Structure& structure, const std::vector<Drive>& drives) {
  std::vector<DrivenLinkage> all;
  for (const Drive& drive : drives) all.push_back({structure, drive.on(structure), exact_motion(structure)});
  return all;
}

Drive hinge_drive_to(const Wall& wall, double theta) {
  Drive drive;
  drive.kind = Drive::Kind::hinge;
  drive.wall = wall;
  drive.angle = turn_at_theta(wall.from.sense(), theta);
  return drive;
}

std::vector<Drive> search_drives(const Structure& structure, double theta) {
  const auto upright = std::find_if(structure.hinges.begin(), structure.hinges.end(),
                                    [](const Hinge& hinge) { return is_vertical(hinge); });
  const Wall wall = (upright == structure.hinges.end() ? structure.hinges.begin() : upright)->wall;
  return {hinge_drive_to(wall, theta), hinge_drive_to(wall, -theta)};
}

}  // namespace kinetix::model
