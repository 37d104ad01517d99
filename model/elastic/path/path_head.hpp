#pragma once

#include "model/elastic/path/measured_system.hpp"
#include "model/elastic/path/predictor.hpp"
#include "model/elastic/path/trial.hpp"

namespace kinetix::model {

/// The state that a path has come to, and the prediction of the next one.
class PathHead {
 public:
  /// Flat. All parameters are kept by reference.
  PathHead(MeasuredSystem& system, const ClosedForm& closed_form);

  const State& state() const { return state_; }
  double theta() const { return theta_; }  ///< rad
  /// Whether the system's tangent is that of the state, factorised: not where the state is unstable.
  bool has_tangent() const { return has_tangent_; }
  bool is_flat() const { return theta_ == 0; }
  /// Whether the path has come along the closed form.
  bool on_closed_form() const { return on_closed_form_; }

  /// Along the tangent, or the closed form while the path keeps to it: that leads through singular points.
  State predicted(double theta);
  /// The state of the path with what the drive holds moved on to theta.
  State carried(double theta) const;
  /// Of the last prediction, 1 or 2.
  int prediction_order() const { return predictor_.order(); }
  /// On the path's branch of it, if there is one: a cord, say, may be as long again at quite another fold.
  std::optional<State> closed_form_ahead(double theta) const;

  /// @param snapped to another state: what is known of the path's direction is lost, as by a descent
  void move_to(Trial trial, bool snapped);
  /// After a trial that was not taken.
  void restore_tangent();

 private:
  MeasuredSystem& system_;
  const ClosedForm& closed_form_;
  Predictor predictor_;
  State state_;
  double theta_ = 0;  ///< rad
  bool has_tangent_ = false, on_closed_form_ = false;
  long factor_ = -1;  ///< of the tangent's: the last one of this state
};

}  // namespace kinetix::model
