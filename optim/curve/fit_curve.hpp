#pragma once

#include <limits>

#include "model/contact/wall_contact.hpp"
#include "optim/curve/curve_reach.hpp"
#include "optim/solvers/multi_start.hpp"
#include "targets/curve/curve_error.hpp"

namespace kinetix::optim {

/// What a curve search may vary.
struct CurveVariables {
  int columns = 40;    ///< >= 2
  int rows = 1;        ///< >= 1; every row does the same
  double cell_mm = 8;  ///< cell edge, mm, > 0
  /// Tilts, rad, in (-pi/2, pi/2), lower < upper.
  AngleRange beta{-60 * radians_per_degree, 60 * radians_per_degree};
  AngleRange theta{2 * radians_per_degree, 44 * radians_per_degree};  ///< rad, in (0, pi/2), lower < upper
  Per per = Per::column;
  Symmetry symmetry = Symmetry::none;

  /// @throws InvalidInput naming field, value and rule
  void validate() const;
};

/// The design found, its error, and what stood in the way.
struct CurveDesign {
  model::ExactDesign<double> design;
  targets::CurveError error;  ///< of the folded midline against the goal
  std::vector<Eigen::Vector2d> midline_mm;
  CurveReach reach;
  MultiStartResult search;
  int chosen = 0;  ///< the run that gave the design
};

/// Searches the tilts and theta that fold a strip into the goal. Of the runs within 1 % of the least |r| it
/// takes the one with the smallest largest tilt: equally good, easier to print.
/// @throws InvalidInput for variables or options that do not validate, and ties that leave nothing to vary
CurveDesign fit_curve(const targets::Curve& goal, const CurveVariables& variables,
                      const MultiStartOptions& options);

/// A design whose walls do not run into each other on the way to its theta, where one was found.
struct FreeCurveDesign {
  CurveDesign design;
  model::ContactLimit contact;  ///< where walls meet on the way to its theta, if they do
  /// In a sentence: the tilts or theta that walls free of contact leave of their range; empty where they leave all.
  std::string narrowed = {};
  std::vector<std::string> notes;  ///< one sentence per bound that was narrowed
};

/// As fit_curve, with tilts kept small where that costs at most a third more error, with theta kept below the
/// angle at which basic cells of these walls close, and, where the walls of the design found still collide,
/// with the tilts narrowed step by step until they do not or the error grows tenfold. Where that misses the goal, the whole
/// range of tilts is searched again at smaller theta, and taken where it comes nearer with its walls free. What is in reach
/// is said of the ranges of `variables`, whatever the search has narrowed.
/// @param enough largest error.rms that meets the goal
FreeCurveDesign fit_free_curve(const targets::Curve& goal, const CurveVariables& variables,
                               const model::CellSize& size, const MultiStartOptions& options,
                               double enough = std::numeric_limits<double>::infinity());

}  // namespace kinetix::optim
