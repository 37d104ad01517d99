#include "model/drive.hpp"

#include <algorithm>
#include <cmath>

#include "model/classify.hpp"
#include "model/invalid_input.hpp"
#include "model/net_grip.hpp"

namespace kinetix {
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

Drive hinge_drive(const Wall& wall, double theta) {
  Drive drive;
  drive.kind = Drive::Kind::hinge;
  drive.wall = wall;
  drive.angle = -2 * wall.from.sense() * theta;
  return drive;
}

Eigen::Vector3d middle_of(const Structure& structure) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const int count = static_cast<int>(structure.bodies.size());
  for (int b = 0; b < count; ++b) sum += structure.rest_position(b);
  return sum / count;
}

/// The vertical one nearest to the middle. @pre a net: every cell has two
const Hinge& middle_hinge(const Structure& structure) {
  const Eigen::Vector3d middle = middle_of(structure);
  const auto rank = [&](const Hinge& hinge) {
    return std::pair(!is_vertical(hinge), (structure.rest_position(hinge.lower) - middle).squaredNorm());
  };
  return *std::min_element(structure.hinges.begin(), structure.hinges.end(),
                           [&](const Hinge& a, const Hinge& b) { return rank(a) < rank(b); });
}

Drive net_drive(const Structure& structure, const Classification& kind, double theta) {
  const auto fold_to = [&](double at) { return fold(kind, structure, at); };
  if (const auto part = find_net_grip(structure)) {
    Drive drive = plate_drive(part->axis, theta);
    drive.grip = part->grip;
    if (keeps_between_plates(structure, gripped_bodies(structure, drive.axis, drive.grip), fold_to))
      return drive;
  }
  return hinge_drive(middle_hinge(structure).wall, theta);
}

}  // namespace

double Drive::theta() const {
  if (kind == Kind::plates) return branch * 2 * std::asin(std::sqrt(compression / 2));
  return -wall.from.sense() * angle / 2;
}

Drive drive_to(const Structure& structure, double theta) {
  if (!(std::abs(theta) < pi / 2))
    throw InvalidInput("theta is " + number_text(theta) + " rad, must be in (-pi/2, pi/2)");
  const Classification kind = classify(structure);
  if (kind.family == Family::F4) return net_drive(structure, kind, theta);
  const auto hinge = std::find_if(structure.hinges.begin(), structure.hinges.end(), is_vertical);
  if (hinge != structure.hinges.end() && !keeps_its_rim_flat(kind, structure))
    return hinge_drive(hinge->wall, theta);
  return plate_drive(kind.transposed ? Axis::x : Axis::y, theta);
}

void validate(const Drive& drive, const Structure& structure) {
  if (drive.kind == Drive::Kind::plates) return validate_plates(drive, structure);
  validate_hinge(drive, structure);
}

}  // namespace kinetix
