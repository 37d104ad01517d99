#include "sim/drive.hpp"

#include <fmt/format.h>

#include <cmath>

#include "model/classify.hpp"
#include "model/invalid_input.hpp"

namespace kinetix {
namespace {

void validate_plates(const Drive& drive) {
  if (!(drive.compression >= 0 && drive.compression < 1))
    throw InvalidInput(fmt::format("drive.compression is {}, must be in [0, 1)", drive.compression));
  if (drive.branch != 1 && drive.branch != -1)
    throw InvalidInput(fmt::format("drive.branch is {}, must be 1 or -1", drive.branch));
}

void validate_hinge(const Drive& drive, const Structure& structure) {
  if (!(std::abs(drive.angle) < pi))
    throw InvalidInput(fmt::format("drive.angle is {} rad, must be in (-pi, pi)", drive.angle));
  if (structure.hinge_at(drive.wall)) return;
  const Vertex from = drive.wall.from, to = drive.wall.to();
  throw InvalidInput(fmt::format("drive.wall [[{}, {}], [{}, {}]] is not a wall of the structure", from.i,
                                 from.j, to.i, to.j));
}

}  // namespace

double Drive::theta() const {
  if (kind == Kind::plates) return branch * std::acos(1 - compression);
  return wall.from.is_class_a() ? -angle / 2 : angle / 2;
}

Drive drive_to(const Structure& structure, double theta) {
  if (!(std::abs(theta) < pi / 2))
    throw InvalidInput(fmt::format("theta is {} rad, must be in (-pi/2, pi/2)", theta));
  Drive drive;
  drive.axis = classify(structure).transposed ? Axis::x : Axis::y;
  drive.compression = 1 - std::cos(theta);
  drive.branch = theta < 0 ? -1 : 1;
  return drive;
}

void validate(const Drive& drive, const Structure& structure) {
  if (drive.kind == Drive::Kind::plates) return validate_plates(drive);
  validate_hinge(drive, structure);
}

}  // namespace kinetix
