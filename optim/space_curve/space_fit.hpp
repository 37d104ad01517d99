#pragma once

#include "model/lattice/square/structure.hpp"
#include "optim/solvers/solver.hpp"
#include "targets/curve/space_curve.hpp"

namespace kinetix::optim {

/// Midline of a strip of one row, in a frame with y across it (kinematics.md section 7). Columns shear and
/// bend in turns: column k shears for even k and bends for odd k. The strip begins with a panel of heading
/// `heading`; each bending column turns the heading. mm and rad.
struct SpaceStrip {
  int columns = 2;                                  ///< >= 2
  double step = 1;                                  ///< L cos(theta): length of a column that does not turn
  std::vector<double> turn;                         ///< of each bending column, from x towards z
  std::vector<double> climb;                        ///< of each shearing column: its step along y over `step`
  double heading = 0;                               ///< of the first panel, from x towards z
  Eigen::Vector3d start = Eigen::Vector3d::Zero();  ///< of the midline

  static bool bends(int column) { return model::column_sign(column) < 0; }
  int bending() const { return columns / 2; }
  int shearing() const { return columns - columns / 2; }

  /// Returns the middle of each column of bodies.
  std::vector<Eigen::Vector3d> midline() const;
};

/// Limits of the columns of a strip.
struct SpaceLimits {
  double turn = 1;                      ///< largest |turn|, rad
  double climb = 1;                     ///< largest |climb|, ratio
  double min_step = 0, max_step = 1e9;  ///< mm
};

/// Fit of such a strip to a goal in its frame.
///
/// x = (turn of each bending column, climb of each shearing one, heading, start over the scale, step over the
/// first step). The residuals are the offsets of two places on each column from the nearest places of the
/// goal, then those of the midline's ends from the goal's ends. All are over the scale and the square root of
/// their number. The nearest place is sought downhill from the place's own fraction of the length.
class SpaceFit final : public LeastSquaresProblem {
 public:
  /// @param goal kept by reference   @param scale mm   @param first gives the number of columns and the first
  /// step
  SpaceFit(const targets::SpaceCurve& goal, double scale, const SpaceStrip& first, const SpaceLimits& limits);

  int variables() const override { return columns_ + 5; }
  int residuals() const override { return 3 * (places_per_column * columns_ + 2); }
  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  bool evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) const override;

  SpaceStrip strip(const Eigen::VectorXd& x) const;
  /// Returns x of a strip, clamped to the bounds.
  Eigen::VectorXd pack(const SpaceStrip& strip) const;

  /// Number of places per column. Its ends also count for its neighbours.
  static constexpr int places_per_column = 2;

 private:
  const targets::SpaceCurve& goal_;
  double scale_;
  int columns_;
  double first_step_;
  Eigen::VectorXd lower_, upper_;
};

/// Returns a strip that follows the goal's headings and heights, without a search.
SpaceStrip followed(const targets::SpaceCurve& goal, int columns);

}  // namespace kinetix::optim
