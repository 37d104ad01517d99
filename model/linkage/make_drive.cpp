#include "model/linkage/make_drive.hpp"

#include <cmath>
#include <numeric>
#include <utility>

#include "model/base/angle.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::model {

LinkageDrive plates_between(GrippedRows rows, Axis axis, double compression, int branch, int bodies) {
  require("drive.compression", compression, compression >= 0 && compression < 1, "in [0, 1)");
  require("drive.branch", branch, branch == 1 || branch == -1, "1 or -1");
  LinkageDrive drive;
  drive.kind = LinkageDrive::Kind::plates;
  drive.axis = axis;
  drive.compression = compression;
  drive.branch = branch;
  drive.gripped = std::move(rows);
  drive.held.resize(bodies);
  std::iota(drive.held.begin(), drive.held.end(), 0);
  return drive;
}

LinkageDrive turned_hinge(int hinge, int sense, double angle) {
  require("drive.angle", angle, std::abs(angle) < pi, "in (-pi, pi) rad");
  LinkageDrive drive;
  drive.kind = LinkageDrive::Kind::hinge;
  drive.hinge = hinge;
  drive.sense = sense;
  drive.angle = angle;
  return drive;
}

}  // namespace kinetix::model
