#include "app/pipeline/design_drive.hpp"

#include "app/pipeline/physics_settings.hpp"
#include "model/elastic/exact_theta.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app {

model::LinkageDrive drive_of(const Design& design) {
  if (design.pull) return {.kind = model::LinkageDrive::Kind::none};
  if (!design.drive) return drive_to(design.structure, design.theta);
  model::SheetDrive drive;
  drive.kind = design.drive->kind;
  drive.axis = design.drive->axis;
  drive.compression = design.drive->compression;
  drive.branch = design.drive->branch.value_or(design.theta < 0 ? -1 : 1);
  drive.grip = design.drive->grip;
  drive.press = design.drive->press;
  drive.hinge = design.drive->hinge;
  drive.angle = design.drive->angle;
  drive.through = design.drive->through;
  drive.shorten_mm = design.drive->shorten_mm;
  drive.springs = design.drive->springs;
  drive.k_turn = design.drive->k_turn;
  return drive_on(design.structure, drive);
}

double exact_theta_of(const Design& design, const model::ExactMotion& exact) {
  if (!design.drive) return design.theta;
  const model::LinkageDrive drive = drive_of(design);
  if (!drive.heats_springs()) return exact.theta_of(drive);
  return exact_theta({design.structure, drive, exact}, elasticity_of(design));
}

}  // namespace kinetix::app
