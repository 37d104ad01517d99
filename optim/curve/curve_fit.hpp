#pragma once

#include "model/lattice/square/family/exact_derivatives.hpp"
#include "model/lattice/square/structure.hpp"
#include "optim/elastic/tilt_ties.hpp"
#include "optim/solvers/solver.hpp"
#include "targets/curve/curve.hpp"

namespace kinetix::optim {

/// Map from few variables to the tilts of all columns.
///
/// Column c turns the strip by 2 atan(tan(beta_c) sin(theta)) with a sign that alternates with c. Equal tilts
/// in neighbouring columns cancel (paper section 5.2). The ties are between *turns*: beta_c = sign_c *
/// x[variable_c], rad.
struct BendTies {
  std::vector<int> variable;  ///< of each column
  std::vector<double> sign;   ///< of each column, 1 or -1, such that x > 0 turns every column the same way
  std::vector<AngleRange> range;  ///< of each variable: values that keep all its columns within bounds

  int columns() const { return static_cast<int>(variable.size()); }
  int variables() const { return static_cast<int>(range.size()); }
};

/// Ties the columns of a strip.
/// @param per column or all
/// @param symmetry of the folded shape. mirror_x and rotate_2 make column N-1-c turn as c does; every curve
/// has mirror_y.
/// @throws InvalidInput for other ties, which leave the exact family, and for a variable whose range is empty
BendTies make_bend_ties(int columns, Per per, Symmetry symmetry, AngleRange beta);

/// Returns the tilts that a search under these ties has found. Ties and ranges are those of the search.
std::vector<TiltTie> tied_tilts(const model::Structure& strip, const BendTies& ties);

/// Fit of a strip's folded midline (family F2) to a curve.
///
/// x = (tangents of the bends of optim/curve/curve_fit.hpp, theta, heading of the strip's frame, its x, its
/// z). Angles are in rad, lengths in units of the goal's bounding-box diagonal. The residuals are the signed
/// distances to the goal of four places on each chord of the midline, then both components of the misfit of
/// both end points. All are divided by the diagonal and by the square root of their number, which makes |r|
/// close to the shape_rms of the state. The closest point is sought downhill from the place's fraction of the
/// arc length.
class CurveFit final : public LeastSquaresProblem {
 public:
  /// @param cell_mm cell edge; @param theta bounds, rad, within (0, pi/2). The goal is kept by reference.
  CurveFit(const targets::Curve& goal, BendTies ties, double cell_mm, AngleRange theta);

  int variables() const override { return ties_.variables() + 4; }
  int residuals() const override { return places_per_cell * ties_.columns() + 4; }
  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  bool evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) const override;

  const BendTies& ties() const { return ties_; }
  const targets::Curve& goal() const { return goal_; }
  double cell_mm() const { return cell_mm_; }

  /// Returns the strip's design, with `rows` rows of cells.
  model::ExactDesign<double> design(const Eigen::VectorXd& x, int rows) const;
  double theta(const Eigen::VectorXd& x) const { return x[ties_.variables()]; }  ///< rad
  /// Returns x for the given column bends (rad, positive turns left) and theta (rad), placed at the start of
  /// the goal and clamped to the bounds.
  Eigen::VectorXd pack(const std::vector<double>& bends, double theta) const;

  /// Number of sampled places per chord. Fewer miss a goal that bulges between two columns; more cost time.
  static constexpr int places_per_cell = 4;

 private:
  class Frame;

  const targets::Curve& goal_;
  BendTies ties_;
  double cell_mm_;
  Eigen::VectorXd lower_, upper_;
};

/// Returns the midline of a folded strip: (x, z) of the bodies of each column in row 0, mm. In F2 with
/// bending columns all bodies of a column have the same x and z.
/// @pre poses of a lattice with `rows` rows
std::vector<Eigen::Vector2d> midline(const model::State& lattice, int rows);

}  // namespace kinetix::optim
