#include "model/drive.hpp"

#include <algorithm>
#include <cmath>

#include "model/classify.hpp"
#include "model/invalid_input.hpp"

namespace kinetix {
namespace {

void validate_plates(const Drive& drive) {
  if (!(drive.compression >= 0 && drive.compression < 1))
    throw InvalidInput("drive.compression is " + number_text(drive.compression) + ", must be in [0, 1)");
  if (drive.branch != 1 && drive.branch != -1)
    throw InvalidInput("drive.branch is " + std::to_string(drive.branch) + ", must be 1 or -1");
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

/// Whether the rows of vertices along the rim stay straight lines or plane curves while the sheet folds.
bool keeps_its_rim_flat(const Classification& kind, const Structure& structure) {
  if (kind.family == Family::none) return is_rectangle(structure);
  if (kind.family == Family::F4) return false;
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

}  // namespace

double Drive::theta() const {
  if (kind == Kind::plates) return branch * 2 * std::asin(std::sqrt(compression / 2));
  return -wall.from.sense() * angle / 2;
}

Drive drive_to(const Structure& structure, double theta) {
  if (!(std::abs(theta) < pi / 2))
    throw InvalidInput("theta is " + number_text(theta) + " rad, must be in (-pi/2, pi/2)");
  const Classification kind = classify(structure);
  const auto hinge = std::find_if(structure.hinges.begin(), structure.hinges.end(), is_vertical);
  if (hinge != structure.hinges.end() && !keeps_its_rim_flat(kind, structure))
    return hinge_drive(hinge->wall, theta);
  return plate_drive(kind.transposed ? Axis::x : Axis::y, theta);
}

void validate(const Drive& drive, const Structure& structure) {
  if (drive.kind == Drive::Kind::plates) return validate_plates(drive);
  validate_hinge(drive, structure);
}

}  // namespace kinetix
