#pragma once

#include "model/lattice/square/structure.hpp"
#include "optim/curve/curve_fit.hpp"
#include "targets/document/edit_document.hpp"

namespace kinetix::app {

/// Settings of a strip that missed its curve.
struct MissedStrip {
  int columns = 0, rows = 1;
  std::optional<double> cell_mm = {};  ///< that the file gives
  /// Columns of a strip as long as the curve, if the present strip is not
  std::optional<int> fitting_columns = {};
  double tilt = 0;                            ///< largest in the file's range, rad, > 0
  optim::AngleRange fold_angle;               ///< the file's, rad
  std::optional<double> hinge_position = {};  ///< upper end of its range, ratio, if the strip climbs
  std::vector<std::string> ties = {};  ///< keys of `variables.tilt` by which tilts depend on each other
  bool walls_meet = false;             ///< whether walls collide, or would with larger tilts
  bool is_steep = false;  ///< whether the curve climbs too much, which more columns do not change
  model::CellSize size = {};
};

/// Returns changes of its file that may bring the strip nearer to its curve, small ones first.
std::vector<targets::DocumentChanges> strip_remedies(const MissedStrip& strip);

}  // namespace kinetix::app
