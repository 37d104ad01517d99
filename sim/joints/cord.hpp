#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/linkage/state.hpp"

namespace kinetix::sim {

/// Tendon through hinge points (model/linkage/actuators.hpp) for the direct solver. It pulls all its bodies
/// with one tension, without friction, and never pushes.
class Cord {
 public:
  /// Makes a tendon of its length at rest. @param structure must outlive this
  Cord(const model::Linkage& structure, std::vector<int> through);

  /// Sets the target length. @param length cell edges
  void shorten_to(double length) { goal_ = length; }
  /// Returns how much longer it is than its target, cell edges; negative if it is slack.
  double excess(const model::State& state) const;
  /// Returns the effect of a unit of tension on the bodies of the structure, six numbers per body: force (v),
  /// then moment (omega).
  Eigen::VectorXd pull(const model::State& state) const;

 private:
  const model::Linkage& structure_;
  const std::vector<int> through_;
  double goal_;  ///< target length, cell edges
};

}  // namespace kinetix::sim
