#pragma once

#include <vector>

#include "model/elastic/adjoint.hpp"

namespace kinetix::model {

/// One direction in which a point of a state is judged: the mean of some bodies' points.
struct ObservedPoint {
  std::vector<int> bodies;  ///< at least one
  Eigen::Vector3d place;    ///< in the state, mm
  Eigen::Vector3d normal;   ///< unit vector, along which the distance from the goal counts
  double miss_mm = 0;       ///< that distance in the state
  /// Observations of the same point, each in its own direction, square to each other: 1 for a distance from a surface,
  /// 2 from a line, 3 from a place. Together they count as one point.
  int directions = 1;
};

/// Observed points of a state and their deviations after the best rigid alignment.
class ObservedPoints {
 public:
  /// @param points kept by reference   @param aligned deviations count after the best small rigid motion
  ObservedPoints(const std::vector<ObservedPoint>& points, bool aligned);

  /// Number of observations: every point as often as it has directions.
  Eigen::Index size() const { return static_cast<Eigen::Index>(points_.size()); }
  /// Number of points, over which the mean of all squares is taken.
  double count() const { return count_; }
  /// As they were given, mm.
  Eigen::VectorXd deviations() const;
  /// Deviations after that motion; as given where they are not aligned. mm
  Eigen::VectorXd without_motion(const Eigen::VectorXd& deviations) const;
  Eigen::VectorXd aligned_deviations() const { return without_motion(deviations()); }
  /// Root mean square over points of their distance as it was given, mm.
  double rms_mm() const;
  /// A mixture of deviations, its rigid part left out, as a function of the state: mm by all coordinates, 6 a body.
  Eigen::VectorXd by_state(const Eigen::VectorXd& mixture, std::size_t bodies, double edge_mm) const;

 private:
  const std::vector<ObservedPoint>& points_;
  double count_ = 0;
  Eigen::MatrixXd rigid_;  ///< orthonormal: what rigid motions do to the deviations
};

}  // namespace kinetix::model
