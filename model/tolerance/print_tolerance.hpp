#pragma once

#include "model/elastic/adjoint.hpp"

namespace kinetix::model {

/// Point of a state and one direction in which its distance from the goal counts. The point is the mean of
/// some bodies' points.
struct ObservedPoint {
  std::vector<int> bodies;  ///< at least one
  Eigen::Vector3d place;    ///< in the state, mm
  Eigen::Vector3d normal;   ///< unit vector along which the distance from the goal counts
  double miss_mm = 0;       ///< that distance in the state.
  /// Number of observations of the same point, each in one of several orthogonal directions: 1 for the
  /// distance from a surface, 2 from a line, 3 from a place. Together they count as one point.
  int directions = 1;
};

/// Observed points and their deviations after optimal rigid alignment.
class ObservedPoints {
 public:
  /// @param points kept by reference   @param aligned whether deviations count after the best small rigid
  ///   motion
  ObservedPoints(const std::vector<ObservedPoint>& points, bool aligned);

  /// Returns the number of observations: each point counts once per direction.
  Eigen::Index size() const { return static_cast<Eigen::Index>(points_.size()); }
  /// Returns the number of points, over which squares are averaged.
  double count() const { return count_; }
  /// Returns the deviations without alignment, mm.
  Eigen::VectorXd deviations() const;
  /// Returns deviations after alignment; unchanged if alignment is off. mm
  Eigen::VectorXd without_rigid_motion(const Eigen::VectorXd& deviations) const;
  Eigen::VectorXd aligned_deviations() const { return without_rigid_motion(deviations()); }
  /// Returns the root mean square distance over points without alignment, mm.
  double rms_mm() const;
  /// Returns the derivatives of a mixture of deviations, after alignment, by all coordinates of the state:
  /// mm, 6 entries per body.
  Eigen::VectorXd by_state(const Eigen::VectorXd& mixture, std::size_t bodies, double edge_mm) const;

 private:
  const std::vector<ObservedPoint>& points_;
  double count_ = 0;
  Eigen::MatrixXd rigid_;  ///< orthonormal basis of the deviations that rigid motions cause
};

/// Standard deviations of printed hinges from the design. All hinges and parameters are independent.
struct HingeScatter {
  double t = 0;       ///< fraction of the wall
  double alpha = 0;   ///< rad
  double beta = 0;    ///< rad
  double offset = 0;  ///< cell edges
  /// One entry per hinge if the hinges differ, otherwise empty. With entries, the numbers above are not used.
  /// The entries' `each` are empty.
  std::vector<HingeScatter> each = {};

  Eigen::Vector4d values() const { return {t, alpha, beta, offset}; }
  /// Returns one column per hinge. @pre each is empty or has one entry per hinge
  Eigen::Matrix4Xd by_hinge(Eigen::Index hinges) const;
};

/// Contribution of one parameter of one hinge to the scatter of prints.
struct ScatterSource {
  int hinge = 0;
  int parameter = 0;  ///< 0 to 3: t, alpha, beta, offset
  double share = 0;   ///< of the variance, [0, 1]
};

/// Standard normal quantile: 95 of 100 values are below it.
inline constexpr double quantile_95 = 1.6448536269514722;

/// Distance of printed structures from the goal, over many prints with errors.
struct ToleranceResult {
  double designed_mm = 0;              ///< rms over the points of the design itself
  double rms_mm = 0;                   ///< root of the mean of its square over prints
  double p95_mm = 0;                   ///< 95 of 100 prints stay below it
  std::vector<ScatterSource> sources;  ///< of all hinges and parameters that scatter, largest first
};

struct ToleranceOptions {
  bool aligned = true;              ///< deviations count after the best rigid motion of the whole shape
  int probes = 150;                 ///< above this number of points, as many random mixtures are used; >= 2
  bool planar = false;              ///< prints move in the plane z = 0 only
  bool contact = false;             ///< walls of prints press on each other in equilibrium
  int most_settled = 1000;          ///< sample prints that may be checked for contact in equilibrium
  unsigned seed = 1;                ///< of the random mixtures
  int threads = 1;                  ///< for the equilibria of prints; 0 = all cores. Does not change results
  std::function<bool()> stop = {};  ///< asked from any thread before each print; true ends the run
};

/// Estimates the print tolerance to first order about an equilibrium under its drive. A print with other
/// hinges settles nearby; the adjoint gives its change.
///
/// The squared rms over points is assumed to follow a gamma distribution of the same mean and variance. Its
/// quantile comes from the cube root (Wilson and Hilferty 1931). With more points than probes, mean and
/// variance are estimated from random mixtures of the points (Hutchinson 1990). The estimate is within about
/// 10 % of the contribution of errors.
///
/// @param tangent linearised at state and factorised without a shift, as for sensitivity()
/// @pre at least one point; one normal and one or more bodies per point
ToleranceResult analyse_print_tolerance(const ElasticSystem& system, const State& state, double theta,
                                        const TangentStiffness& tangent,
                                        const std::vector<ObservedPoint>& points, const HingeScatter& scatter,
                                        const ToleranceOptions& options = {});

}  // namespace kinetix::model
