#pragma once

#include "model/lattice/square/family/exact_jacobian.hpp"
#include "optim/curve/bend_ties.hpp"
#include "optim/solvers/least_squares.hpp"
#include "targets/curve/curve.hpp"

namespace kinetix::optim {

/// Fit of a strip's folded midline (family F2) to a curve.
///
/// x = (tangents of the bends of optim/curve/bend_ties.hpp, theta, heading of the strip's frame, its x, its
/// z); angles in rad, lengths in units of the goal's bounding-box diagonal. Residuals: signed distance to the
/// goal of four places on each chord of the midline, and both components of both end points' misfit, over the
/// diagonal and the square root of their number, so that |r| is close to the shape_rms of the state. The
/// closest point of a place is sought downhill from its own fraction of the arc length.
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

  /// The strip's design, with `rows` rows of cells.
  model::ExactDesign<double> design(const Eigen::VectorXd& x, int rows) const;
  double theta(const Eigen::VectorXd& x) const { return x[ties_.variables()]; }  ///< rad
  /// x from column bends (rad, positive turns left), theta (rad) and the goal's own start; clamped to the
  /// bounds.
  Eigen::VectorXd pack(const std::vector<double>& bends, double theta) const;

  /// Of each chord: with fewer, a goal that bulges between two columns goes unseen; more cost time.
  static constexpr int places_per_cell = 4;

 private:
  class Frame;

  const targets::Curve& goal_;
  BendTies ties_;
  double cell_mm_;
  Eigen::VectorXd lower_, upper_;
};

/// Midline of a folded strip: (x, z) of the bodies of each column in row 0, mm. For F2 with bending columns
/// all bodies of a column have the same x and z. @pre poses of a lattice with `rows` rows
std::vector<Eigen::Vector2d> midline(const model::State& lattice, int rows);

}  // namespace kinetix::optim
