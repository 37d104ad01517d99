#pragma once

#include <limits>

#include "model/contact/wall_contact.hpp"
#include "optim/curve/curve_reach.hpp"
#include "optim/solvers/multi_start.hpp"
#include "targets/curve/curve_error.hpp"

namespace kinetix::optim {

/// Variables of a curve search.
struct CurveVariables {
  int columns = 40;    ///< >= 2
  int rows = 1;        ///< >= 1; all rows fold in the same way
  double cell_mm = 8;  ///< cell edge, mm, > 0
  /// Tilts, rad, in (-pi/2, pi/2), lower < upper.
  AngleRange beta{-60 * radians_per_degree, 60 * radians_per_degree};
  AngleRange theta{2 * radians_per_degree, 44 * radians_per_degree};  ///< rad, in (0, pi/2), lower < upper
  Per per = Per::column;
  Symmetry symmetry = Symmetry::none;

  /// @throws InvalidInput naming field, value and rule
  void validate() const;
};

/// Design found, its error, and the obstacles.
struct CurveDesign {
  model::ExactDesign<double> design;
  targets::CurveError error;  ///< of the folded midline against the goal
  std::vector<Eigen::Vector2d> midline_mm;
  CurveReach reach;
  MultiStartResult search;
  int chosen = 0;  ///< the run that gave the design
};

/// Searches the tilts and theta that fold a strip into the goal. Of the runs within 1 % of the least |r| it
/// picks the one with the smallest largest tilt, which is as good and easier to print.
/// @throws InvalidInput for invalid variables or options, and for ties that leave nothing to vary
CurveDesign fit_curve(const targets::Curve& goal, const CurveVariables& variables,
                      const MultiStartOptions& options);

/// Design whose walls do not collide up to its theta, if one was found.
struct FreeCurveDesign {
  CurveDesign design;
  model::ContactLimit contact;  ///< first wall contact up to its theta, if any.
  /// One sentence with the tilts or theta that remain when walls are free of contact; empty if all of the
  /// range remains.
  std::string narrowed = {};
  std::vector<std::string> notes;  ///< one sentence per bound that was narrowed
};

/// Searches a design whose walls do not collide. Works like fit_curve, with these changes:
/// - Tilts stay small if that costs at most a third more error.
/// - theta stays below the angle at which basic cells of these walls close.
/// - If walls of the design found still collide, the tilts are narrowed step by step until the walls are free
/// or the error has grown tenfold.
/// - If the result misses the goal, the whole range of tilts is searched again at smaller theta. A design
/// with free walls that is nearer to the goal then replaces it.
/// The reach is reported for the ranges of `variables`, even if the search has narrowed them.
/// @param enough largest error.rms that meets the goal
FreeCurveDesign fit_free_curve(const targets::Curve& goal, const CurveVariables& variables,
                               const model::CellSize& size, const MultiStartOptions& options,
                               double enough = std::numeric_limits<double>::infinity());

}  // namespace kinetix::optim
