#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "model/tolerance/as_made.hpp"

namespace kinetix::model {

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

}  // namespace kinetix::model
