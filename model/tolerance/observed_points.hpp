#pragma once

#include <vector>

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
  Eigen::VectorXd without_motion(const Eigen::VectorXd& deviations) const;
  Eigen::VectorXd aligned_deviations() const { return without_motion(deviations()); }
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

}  // namespace kinetix::model
