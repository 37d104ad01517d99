#pragma once

namespace kinetix::optim {

/// Sharing of variables between hinges: one variable per column, row, ...
enum class Per { column, row, cell, hinge, all };

/// Symmetry of the folded shape under a motion of the flat sheet onto itself.
enum class Symmetry { none, mirror_x, mirror_y, rotate_2, rotate_4 };

/// Closed interval of an angle, rad.
struct AngleRange {
  double lower = 0, upper = 0;
};

}  // namespace kinetix::optim
