#include "app/pipeline/design_drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/base/invalid_input.hpp"
#include "model/closure/closure_drive.hpp"
#include "model/lattice/square/net_grip.hpp"

namespace kinetix::app {
namespace {

constexpr int scan_steps = 900;                       // of a tenth of a degree, to part close roots
constexpr double widest = 89.9 * radians_per_degree;  // rad; at 90 deg every cell is closed

/// What the drive prescribes, as a structure in a state has it, minus what is asked.
class DriveMiss {
 public:
  DriveMiss(const model::Drive& drive, const model::Classification& family, const model::Structure& structure)
      : drive_(drive), family_(family), structure_(structure) {
    if (drive.kind == model::Drive::Kind::hinge) hinge_ = *structure.hinge_at(drive.wall);
    const model::GrippedRows rim = gripped_bodies(structure, drive_.axis, drive_.grip);
    first_ = rim[0].front();
    last_ = rim[1].front();
  }

  double operator()(double theta) const {
    const model::State state = fold(family_, structure_, theta);
    if (drive_.kind == model::Drive::Kind::hinge) return hinge_turn(structure_, state, hinge_) - drive_.angle;
    const int d = drive_.axis == model::Axis::x ? 0 : 1;
    const double rest = structure_.rest_position(last_)[d] - structure_.rest_position(first_)[d];
    return 1 - (state[last_].p[d] - state[first_].p[d]) / rest - drive_.compression;
  }

 private:
  const model::Drive& drive_;
  const model::Classification& family_;
  const model::Structure& structure_;
  int hinge_ = 0, first_ = 0, last_ = 0;
};

double bisect(const DriveMiss& miss, double a, double b) {
  const bool rising = miss(b) > 0;
  for (int k = 0; k < 80; ++k) {
    const double middle = (a + b) / 2;
    ((miss(middle) > 0) == rising ? b : a) = middle;
  }
  return (a + b) / 2;
}

const char* name_of(model::Axis axis) { return axis == model::Axis::x ? "x" : "y"; }

/// The closed form leaves rows free that plates would hold straight.
void refuse_rows_that_curve(const model::Drive& drive, const model::Classification& family,
                            const model::Structure& structure) {
  if (drive.kind != model::Drive::Kind::plates || family.family != model::Family::planar) return;
  const model::GrippedRows rows = gripped_bodies(structure, drive.axis, drive.grip);
  if (keeps_rows_straight(family.redrawing, drive.axis, rows)) return;
  throw InvalidInput(
      fmt::format("plates normal to {0} would hold rows straight that curve in this panel's exact "
                  "motion; allowed: kind: hinge, or --model equilibrium",
                  name_of(drive.axis)),
      {"", 0, 0, "drive.axis"});
}

/// Between plates normal to the direction in which it bends, a sheet can roll: its theta is not determined.
void refuse_plates_that_tilt(const model::Drive& drive, const model::Classification& family) {
  const model::Axis bends_along = family.transposed ? model::Axis::y : model::Axis::x;
  if (drive.kind != model::Drive::Kind::plates || family.family == model::Family::F1 ||
      family.family == model::Family::planar || drive.axis != bends_along)
    return;
  throw InvalidInput(
      fmt::format("this sheet bends along {0} and would roll between plates normal to {0}; allowed: {1}, "
                  "or kind: hinge",
                  name_of(bends_along), bends_along == model::Axis::x ? "y" : "x"),
      {"", 0, 0, "drive.axis"});
}

}  // namespace

model::Drive drive_of(const DesignFile& design) {
  if (!design.drive) return drive_to(design.structure, design.theta);
  model::Drive drive;
  const bool plates = design.drive->kind == DriveSection::Kind::plates;
  drive.kind = plates ? model::Drive::Kind::plates : model::Drive::Kind::hinge;
  drive.axis = design.drive->axis;
  drive.compression = design.drive->compression;
  drive.branch = design.drive->branch.value_or(design.theta < 0 ? -1 : 1);
  drive.grip = design.drive->grip;
  drive.wall = design.drive->wall;
  drive.angle = design.drive->angle;
  return drive;
}

double theta_of(const model::Drive& drive, const model::Classification& family,
                const model::Structure& structure) {
  const bool plates = drive.kind == model::Drive::Kind::plates;
  if (plates && family.family != model::Family::planar &&
      (drive.grip || family.family == model::Family::F4)) {
    require_kept_rows(structure, family, drive.axis, drive.grip);
    return drive.theta();
  }
  refuse_plates_that_tilt(drive, family);
  refuse_rows_that_curve(drive, family, structure);
  const DriveMiss miss(drive, family, structure);
  const bool backwards = plates ? drive.branch < 0 : drive.theta() < 0;
  const double step = (backwards ? -widest : widest) / scan_steps;
  double before = miss(0);
  if (before == 0) return 0;
  for (int k = 1; k <= scan_steps; ++k) {
    const double now = miss(k * step);
    if (now == 0 || (now > 0) != (before > 0)) return bisect(miss, (k - 1) * step, k * step);
    before = now;
  }
  throw InvalidInput(
      fmt::format("drive: no theta up to {:.1f} deg gives this structure what the drive asks for",
                  widest / radians_per_degree));
}

}  // namespace kinetix::app
