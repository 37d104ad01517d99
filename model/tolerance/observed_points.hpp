#pragma once

#include <vector>

#include "model/elastic/adjoint.hpp"

namespace kinetix::model {

/// A point by which a state is judged: the mean of some bodies' points, seen along one direction.
struct ObservedPoint {
  std::vector<int> bodies;  ///< at least one
  Eigen::Vector3d place;    ///< in the state, mm
  Eigen::Vector3d normal;   ///< direction along which its distance from the goal counts, as long as it weighs
  double miss_mm = 0;       ///< that distance in the state, times the weight
};

/// All points of a state, and what of their deviations rigid motion of the whole cannot take away.
class ObservedPoints {
 public:
  /// @param points kept by reference   @param aligned deviations count after the best small rigid motion
  ObservedPoints(const std::vector<ObservedPoint>& points, bool aligned);

  Eigen::Index size() const { return static_cast<Eigen::Index>(points_.size()); }
  /// As they were given, mm.
  Eigen::VectorXd deviations() const;
  /// After that motion; as given where they are not aligned. mm
  Eigen::VectorXd aligned_deviations() const { return without_motion(deviations()); }
  /// Root mean square of the deviations as they were given, mm.
  double rms_mm() const;
  /// A mixture of deviations, its rigid part left out, as a function of the state: mm by all coordinates, 6 a body.
  Eigen::VectorXd by_state(const Eigen::VectorXd& mixture, std::size_t bodies, double edge_mm) const;

 private:
  Eigen::VectorXd without_motion(const Eigen::VectorXd& deviations) const;

  const std::vector<ObservedPoint>& points_;
  Eigen::MatrixXd rigid_;  ///< orthonormal: what rigid motions do to the deviations
};

}  // namespace kinetix::model
