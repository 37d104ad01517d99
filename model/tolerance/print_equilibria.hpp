#pragma once

#include <random>

#include "model/elastic/adjoint.hpp"
#include "model/tolerance/print_tolerance.hpp"

namespace kinetix::model {

/// Generator of errors of one print after the other: one column per hinge with t (fraction), alpha, beta
/// (rad) and offset (cell edges). Normally distributed, by Box and Muller: the distributions of the standard
/// library differ between implementations.
class PrintErrors {
 public:
  PrintErrors(const HingeScatter& scatter, Eigen::Index hinges, unsigned seed)
      : sd_(scatter.by_hinge(hinges)), random_(seed) {}

  Eigen::Matrix4Xd next() {
    Eigen::Matrix4Xd errors(4, sd_.cols());
    for (double& entry : errors.reshaped()) entry = normal();
    return sd_.cwiseProduct(errors);
  }

 private:
  double even() {
    return (static_cast<double>(random_()) + 1) / (static_cast<double>(std::mt19937::max()) + 2);
  }
  double normal() {
    const double radius = std::sqrt(-2 * std::log(even()));
    return radius * std::cos(2 * std::numbers::pi * even());
  }

  const Eigen::Matrix4Xd sd_;
  std::mt19937 random_;
};

/// Function that returns the structure with hinge errors: one column per hinge with t (fraction), alpha, beta
/// (rad) and offset (cell edges). Without columns it is the design itself.
using PrintedLinkage = std::function<Linkage(const Eigen::Matrix4Xd& errors)>;

/// Structure under its drive, of which prints are made.
struct PrintScene {
  PrintedLinkage printed;  ///< called from any thread
  Elasticity elasticity;
  LinkageDrive drive;
  bool planar = false, contact = false;

  ElasticSystem system(const Eigen::Matrix4Xd& errors) const {
    return {printed(errors), elasticity, drive, planar, contact};
  }
};

/// Rad, cell edges: last Newton step. Errors move distances by at least a hundredth, so it is small enough.
inline constexpr double at_rest = 1e-7;

/// Solver for equilibria of prints. Each search starts from the equilibrium of the design with the factor of
/// the design. If prints differ little, most of them converge without a factor of their own matrix. The state
/// of a print does not depend on other prints or on the number of threads.
class PrintEquilibria {
 public:
  struct Print {
    bool tried = false;
    /// Empty if no stable equilibrium is found, or if walls in contact overlap as built.
    std::optional<State> state = {};
  };

  /// @param state of the design, in equilibrium or nearly so
  /// @param most largest number of prints per call of of(), > 0
  /// @param options only threads and stop have an effect
  PrintEquilibria(PrintScene scene, const State& state, int most, const ToleranceOptions& options);
  ~PrintEquilibria();
  PrintEquilibria(const PrintEquilibria&) = delete;
  PrintEquilibria& operator=(const PrintEquilibria&) = delete;

  Eigen::Index hinges() const;
  /// Returns the equilibrium of the design.
  const State& design() const;
  /// Finds the equilibria of several prints, in their order. Prints are not tried after options.stop returns
  /// true.
  std::vector<Print> of(const std::vector<Eigen::Matrix4Xd>& errors);

 private:
  struct Workers;
  std::unique_ptr<Workers> workers_;
};

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
