#pragma once

#include <optional>

#include "model/elastic/adjoint.hpp"

namespace kinetix::model {

/// A state of a design, and what holds it there.
struct HeldState {
  State state;  ///< in equilibrium or nearly so
  Elasticity elasticity;
  LinkageDrive drive;
};

/// A design brought to its equilibrium under what holds it, without contact, and how its prints differ from it to first order.
class SettledDesign {
 public:
  /// @param planar it moves in the plane z = 0 only
  SettledDesign(Linkage linkage, HeldState held, bool planar);
  SettledDesign(const SettledDesign&) = delete;
  SettledDesign& operator=(const SettledDesign&) = delete;

  /// Whether a stable equilibrium was found: else there is nothing to first order.
  bool is_stable() const { return by_hinges_.has_value(); }
  const State& state() const { return held_.state; }
  const Elasticity& elasticity() const { return held_.elasticity; }
  const LinkageDrive& drive() const { return held_.drive; }
  double theta() const { return held_.drive.theta(); }
  const ElasticSystem& system() const { return system_; }
  const TangentStiffness& tangent() const { return tangent_; }
  /// DesignSensitivities::change. @pre is_stable()
  Eigen::VectorXd change(const Eigen::Matrix4Xd& errors) const { return by_hinges_->change(errors); }

 private:
  HeldState held_;
  ElasticSystem system_;
  TangentStiffness tangent_;
  std::optional<DesignSensitivities> by_hinges_;
};

}  // namespace kinetix::model
