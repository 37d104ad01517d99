#pragma once

#include "model/elastic/elastic_system.hpp"

namespace kinetix::model {

/// Predictor of the next state of an equilibrium path: along its tangent, with the curvature from the change
/// of the tangent since the last state.
class Predictor {
 public:
  explicit Predictor(const ElasticSystem& system) : system_(system) {}

  /// Predicts the state at fold parameter `to`, rad, with the gripped bodies in place. Of the predictions of
  /// first and second order, the one with less energy is used. No hinge turns by more than 0.3 rad or opens
  /// by more than 0.3 cell edges.
  /// @param state in equilibrium at `from`
  /// @param tangent its tangent, factorised; needed only for the first prediction from a state
  State predict(const State& state, double from, double to, const TangentStiffness& tangent);
  /// Returns the order of the last prediction, 1 or 2. Its error scales with the step to the power of order +
  /// 1.
  int order() const { return order_; }

  /// Records that the path has moved from the state at `from` to another on the same branch.
  void move_on(double from, double to);
  /// Records that the path has left its branch.
  void restart();

 private:
  State ahead(const State& state, double to, Eigen::VectorXd step) const;

  const ElasticSystem& system_;
  Eigen::VectorXd rate_, last_rate_;  ///< derivatives by theta, all coordinates; empty if unknown
  double last_theta_ = 0;
  int order_ = 1;
};

}  // namespace kinetix::model
