#include "app/pipeline/design_drive.hpp"

#include "app/pipeline/physics_settings.hpp"
#include "model/elastic/exact_theta.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app {

model::LinkageDrive drive_of(const Design& design) {
  if (!design.drive) return drive_to(design.structure, design.theta);
  return drive_on(design.structure, *design.drive, design.theta);
}

double exact_theta_of(const Design& design, const model::ExactMotion& exact) {
  if (!design.drive) return design.theta;
  const model::LinkageDrive drive = drive_of(design);
  if (drive.acts_from_outside()) return exact.theta_of(drive);
  return exact_theta({design.structure, drive, exact}, elasticity_of(design));
}

}  // namespace kinetix::app
