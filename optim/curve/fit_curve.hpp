#pragma once

#include <limits>
#include <optional>

#include "model/contact/wall_contact.hpp"
#include "optim/curve/curve_fit.hpp"
#include "optim/solvers/multi_start.hpp"
#include "targets/curve/curve.hpp"

namespace kinetix::optim {

/// Turn that one column needs to follow the goal, and the turn that its bounds allow at the given theta.
struct ColumnTurn {
  int column = 0;
  double arc_mm = 0;   ///< position of the column's hinge along the goal
  double needed = 0;   ///< rad, signed, left > 0
  double allowed = 0;  ///< rad, >= 0: largest turn to that side within the bounds
  double excess = 0;   ///< rad, >= 0: how far `needed` is outside the turns that the bounds allow
};

/// Shapes that the bounds and the cell count allow, compared with the goal.
struct CurveReach {
  double theta = 0;        ///< rad: gives the straight strip the goal's length, clamped to its bounds
  double shortest_mm = 0;  ///< length of the straight strip at the largest theta
  double longest_mm = 0;   ///< length of the straight strip at the smallest theta
  std::vector<ColumnTurn> turns;
  /// Number of columns whose strip has the goal's length; empty if the present one can have it.
  std::optional<int> fitting_columns = {};
  /// Reasons why the goal is out of reach, with numbers and without advice; empty when none was found.
  std::vector<std::string> obstacles;
};

/// Returns the turn that column `column` of `columns` needs to follow the goal, rad, left > 0. It is the turn
/// between the chords of one column's length before and after the column's hinge, cut off at the ends of the
/// goal.
double needed_turn(const targets::Curve& goal, int column, int columns);

/// Compares the needed turn of each column with 2 atan(tan(beta) sin(theta)) of its largest tilt.
CurveReach analyse_reach(const CurveFit& fit);

/// Half turns psi_c of the columns (rad) that lay the chords of a strip end to end along a curve.
struct ChordLayout {
  std::vector<double> psi;     ///< half turn of each column, rad, positive turns left
  std::vector<double> arc;     ///< arc length of each of the columns + 1 chord ends on the goal, mm
  double carried_edge_mm = 0;  ///< edge L cos(theta) of a folded cell that gives the chords their length
};

/// Lays the chords of a strip along the goal. Chord c leaves direction tau_c by psi_c, has length L
/// cos(theta) cos(psi_c), and tau_{c+1} = tau_c + 2 psi_c. One degree of freedom remains: a zigzag (psi_0,
/// -psi_0, ...) that changes no chord direction.
/// @param zigzag added to the smoothest layout (least sum of psi^2), rad
ChordLayout lay_chords(const targets::Curve& goal, int columns, double zigzag);

/// Returns start k of a search, as x of CurveFit in its units. Start 0 is the smoothest layout. If the bounds
/// cut that layout, start 1 turns all columns by the same amount, often the best under tight bounds. The
/// other starts are zigzags of growing size, random from `zigzag_starts` on. The result depends on (seed, k)
/// only.
Eigen::VectorXd curve_start(const CurveFit& fit, int k, std::uint64_t seed);

inline constexpr int zigzag_starts = 16;  ///< starts by rule, with zigzags of up to 0.35 rad; the others are
                                          ///< random

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
