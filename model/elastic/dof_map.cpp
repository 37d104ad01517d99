#include "model/elastic/dof_map.hpp"

namespace kinetix::model {
namespace {

enum Coordinate { turn_x, turn_y, turn_z, shift_x, shift_y, shift_z };

using Held = std::vector<std::array<bool, 6>>;

void hold_plates(const LinkageDrive& drive, Held& held) {
  const bool along_y = drive.axis == Axis::y;
  const GrippedRows& rows = drive.gripped;
  for (const auto& row : rows) {
    for (const int body : row) held[body][along_y ? shift_y : shift_x] = true;
    held[row[row.size() / 2]][shift_z] = true;
  }
  const int pin = rows[0][rows[0].size() / 2];
  held[pin][along_y ? shift_x : shift_y] = true;
  held[pin][along_y ? turn_y : turn_x] = true;
}

Held planes(const Linkage& structure, bool planar) {
  return Held(structure.bodies.size(), {planar, planar, false, false, false, planar});
}

DofMap numbered(const Held& held) {
  DofMap dofs;
  dofs.unknown.resize(held.size());
  for (std::size_t b = 0; b < held.size(); ++b)
    for (int c = 0; c < 6; ++c) dofs.unknown[b][c] = held[b][c] ? -1 : dofs.count++;
  return dofs;
}

}  // namespace

Eigen::VectorXd DofMap::restrict(const Eigen::VectorXd& all) const {
  Eigen::VectorXd out(count);
  for (std::size_t b = 0; b < unknown.size(); ++b)
    for (int c = 0; c < 6; ++c)
      if (unknown[b][c] >= 0) out[unknown[b][c]] = all[6 * b + c];
  return out;
}

Eigen::VectorXd DofMap::extend(const Eigen::VectorXd& unknowns) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(coordinates());
  for (std::size_t b = 0; b < unknown.size(); ++b)
    for (int c = 0; c < 6; ++c)
      if (unknown[b][c] >= 0) out[6 * b + c] = unknowns[unknown[b][c]];
  return out;
}

int held_body(const Linkage& structure, const LinkageDrive& drive) {
  if (drive.kind == LinkageDrive::Kind::hinge) return structure.hinges[drive.hinge].lower;
  return static_cast<int>(structure.bodies.size() / 2);
}

DofMap make_dof_map(const Linkage& structure, const LinkageDrive& drive, bool planar) {
  Held held = planes(structure, planar);
  if (drive.kind == LinkageDrive::Kind::plates)
    hold_plates(drive, held);
  else
    held[held_body(structure, drive)].fill(true);
  return numbered(held);
}

}  // namespace kinetix::model
