#include "model/lattice/square/family/square_theta.hpp"

#include "model/base/invalid_input.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/lattice/planar/planar_drive.hpp"
#include "model/lattice/square/family/net_grip.hpp"

namespace kinetix::model {
namespace {

/// Rejects plates normal to the direction in which a sheet bends: it can roll between them, so its theta is not
/// determined.
void refuse_plates_that_tilt(const LinkageDrive& drive, const Classification& kind) {
  const Axis bends_along = kind.transposed ? Axis::y : Axis::x;
  if (kind.family == Family::F1 || drive.axis != bends_along) return;
  const std::string along = to_string(bends_along);
  throw InvalidInput("this sheet bends along " + along + " and would roll between plates normal to " + along +
                         "; allowed: " + to_string(kind.transposed ? Axis::x : Axis::y) + ", or kind: hinge",
                     {"", 0, 0, "drive.axis"});
}

}  // namespace

double theta_of(const LinkageDrive& drive, const Classification& kind, const Structure& structure) {
  if (drive.has_plates()) {
    if (kind.family == Family::planar) {
      refuse_rows_that_curve(drive, kind.redrawing);
    } else if (drive.grips_part || kind.family == Family::F4) {
      require_kept_rows(structure, kind, drive.axis, drive.gripped,
                        drive.grips_part ? "that part of the structure" : "this net");
      return drive.theta();
    } else {
      refuse_plates_that_tilt(drive, kind);
    }
  }
  return theta_of(drive, structure, [&](double theta) { return fold(kind, structure, theta); });
}

}  // namespace kinetix::model
