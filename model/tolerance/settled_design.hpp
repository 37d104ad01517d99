#pragma once

#include <optional>

#include "model/elastic/adjoint.hpp"

namespace kinetix::model {

/// State of a design with the elasticity and drive that hold it in equilibrium.
struct HeldState {
  State state;  ///< in equilibrium or nearly so
  Elasticity elasticity;
  LinkageDrive drive;
};

/// A design brought to equilibrium under its drive, without contact, with the first-order changes of its
/// prints.
class SettledDesign {
 public:
  /// @param planar the design moves in the plane z = 0 only
  SettledDesign(Linkage linkage, HeldState held, bool planar);
  SettledDesign(const SettledDesign&) = delete;
  SettledDesign& operator=(const SettledDesign&) = delete;

  /// Returns whether a stable equilibrium was found. Only then first-order changes exist.
  bool is_stable() const { return by_hinges_.has_value(); }
  const State& state() const { return held_.state; }
  const Elasticity& elasticity() const { return held_.elasticity; }
  const LinkageDrive& drive() const { return held_.drive; }
  double theta() const { return held_.drive.theta(); }
  const ElasticSystem& system() const { return system_; }
  const TangentStiffness& tangent() const { return tangent_; }
  /// Returns the first-order change of the state, as DesignSensitivities::change. @pre is_stable()
  Eigen::VectorXd change(const Eigen::Matrix4Xd& errors) const { return by_hinges_->change(errors); }

 private:
  HeldState held_;
  ElasticSystem system_;
  TangentStiffness tangent_;
  std::optional<DesignSensitivities> by_hinges_;
};

}  // namespace kinetix::model
