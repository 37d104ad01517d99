#pragma once

#include "model/elastic/path/measured_system.hpp"
#include "model/elastic/path/predictor.hpp"
#include "model/elastic/path/trial.hpp"

namespace kinetix::model {

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
