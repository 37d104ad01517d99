#pragma once

#include "model/lattice/square/structure.hpp"
#include "optim/curve/curve_fit.hpp"
#include "targets/document/edit_document.hpp"

namespace kinetix::app {

/// Settings of a strip that missed its curve.
struct MissedStrip {
  int columns = 0, rows = 1;
  std::optional<double> cell_mm = {};  ///< that the file gives
  std::optional<int> fitting_columns =
      {};                        ///< whose strip has the length of the curve, if the present one has not
  double tilt = 0;               ///< largest in the file's range, rad, > 0
  optim::AngleRange fold_angle;  ///< the file's, rad
  std::optional<double> hinge_position = {};  ///< upper end of its range, ratio; of strips that climb
  std::vector<std::string> ties = {};         ///< keys of `variables.tilt` that tie tilts, with other values
  bool walls_meet = false;                    ///< whether walls collide, or would with larger tilts
  bool is_steep = false;  ///< whether the curve climbs too much, which more columns do not change
  model::CellSize size = {};
};

/// Returns changes of its file that may bring the strip nearer to its curve, small ones first.
std::vector<targets::DocumentChanges> strip_remedies(const MissedStrip& strip);

}  // namespace kinetix::app
