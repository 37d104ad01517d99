#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/linkage/state.hpp"

namespace kinetix::sim {

/// A cord through hinge points (model/linkage/actuators.hpp) as the direct solver has it: it pulls all its bodies with one
/// tension, without friction, and never pushes.
class Cord {
 public:
  /// As long as at rest. @param structure must outlive this
  Cord(const model::Linkage& structure, std::vector<int> through);

  /// @param length cell edges
  void shorten_to(double length) { goal_ = length; }
  /// How much longer it is than it should be, cell edges; below 0 where it is slack.
  double excess(const model::State& state) const;
  /// What a unit of tension does to the bodies of the structure, six numbers a body: force (v), then moment (omega).
  Eigen::VectorXd pull(const model::State& state) const;

 private:
  const model::Linkage& structure_;
  const std::vector<int> through_;
  double goal_;  ///< cell edges
};

}  // namespace kinetix::sim
