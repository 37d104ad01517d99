#pragma once

#include "model/elastic/elastic_system.hpp"
#include "model/elastic/path/branch.hpp"
#include "model/elastic/path/measured_system.hpp"

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

/// Present state of a path, and the prediction of the next one.
class PathHead {
 public:
  /// Starts in the flat state. All parameters are kept by reference.
  PathHead(MeasuredSystem& system, const ClosedForm& closed_form);

  const State& state() const { return state_; }
  double theta() const { return theta_; }  ///< rad
  /// Returns whether the system's tangent is that of the state, factorised. False if the state is unstable.
  bool has_tangent() const { return has_tangent_; }
  bool is_flat() const { return theta_ == 0; }
  /// Returns whether the path has followed the closed form up to here.
  bool on_closed_form() const { return on_closed_form_; }

  /// Predicts the state along the tangent. While the path follows the closed form, the closed form is used if
  /// it has less energy, since it passes through singular points.
  State predicted(double theta);
  /// Returns the present state with the driven bodies moved to theta.
  State carried(double theta) const;
  /// Returns the order of the last prediction, 1 or 2.
  int prediction_order() const { return predictor_.order(); }
  /// Returns the closed form at theta if it is on the present branch. A tendon, for example, may have the
  /// same length at a very different fold.
  std::optional<State> closed_form_ahead(double theta) const;

  /// Accepts a trial as the present state.
  /// @param snapped whether it is on another branch: known directions of the path are discarded, as after a
  ///   descent
  void move_to(Trial trial, bool snapped);
  /// Restores the tangent of the present state after a refused trial.
  void restore_tangent();

 private:
  MeasuredSystem& system_;
  const ClosedForm& closed_form_;
  Predictor predictor_;
  State state_;
  double theta_ = 0;  ///< rad
  bool has_tangent_ = false, on_closed_form_ = false;
  long factor_ = -1;  ///< count of the tangent's factors at the last one of this state
};

}  // namespace kinetix::model
