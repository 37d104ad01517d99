#pragma once

#include "model/elastic/elastic_system.hpp"

namespace kinetix::model {

/// Where a path of equilibrium goes next: along its tangent, and bent as the tangent has turned since the
/// state before.
class Predictor {
 public:
  explicit Predictor(const ElasticSystem& system) : system_(system) {}

  /// The state expected at fold parameter `to`, rad, what the drive grips in place: of first or second order,
  /// whichever has less energy. No hinge turns or opens by more than 0.3 rad or cell edges.
  /// @param state in equilibrium at `from`  @param tangent its tangent, factorised; needed for the first
  /// prediction from a state only
  State predict(const State& state, double from, double to, const TangentStiffness& tangent);
  /// 1 or 2: of the last prediction. Its error grows with the step to one power more.
  int order() const { return order_; }

  /// The path has left the state at `from` for another on the same branch.
  void move_on(double from, double to);
  /// The path has left its branch.
  void restart();

 private:
  State ahead(const State& state, double to, Eigen::VectorXd step) const;

  const ElasticSystem& system_;
  Eigen::VectorXd rate_, last_rate_;  ///< by theta, all coordinates; empty where not known
  double last_theta_ = 0;
  int order_ = 1;
};

}  // namespace kinetix::model
