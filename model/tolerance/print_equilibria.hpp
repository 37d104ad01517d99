#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "model/tolerance/as_made.hpp"

namespace kinetix::model {

/// A structure with its hinges off by so much: a column a hinge, t (fraction), alpha, beta (rad), offset (cell edges). No
/// columns: the design itself.
using PrintedLinkage = std::function<Linkage(const Eigen::Matrix4Xd& errors)>;

/// A structure under its drive, of which prints are made.
struct PrintScene {
  PrintedLinkage printed;  ///< called from any thread
  Elasticity elasticity;
  LinkageDrive drive;
  bool planar = false, contact = false;

  ElasticSystem system(const Eigen::Matrix4Xd& errors) const {
    return {printed(errors), elasticity, drive, planar, contact};
  }
};

/// Rad, cell edges: a last step that is good for distances, which errors move by a hundredth at the least.
inline constexpr double at_rest = 1e-7;

/// Finds equilibria of prints, each from that of the design and by its factor first: where prints differ little, most of them
/// come to rest without one of their own. The state of a print depends on no other print and not on the number of threads.
class PrintEquilibria {
 public:
  struct Print {
    bool tried = false;
    /// Nothing where no stable equilibrium is found, and where walls that press on each other overlap as built.
    std::optional<State> state = {};
  };

  /// @param state of the design, in equilibrium or nearly so   @param most prints that are found at once, > 0
  /// @param options threads and stop have an effect
  PrintEquilibria(PrintScene scene, const State& state, int most, const AsMadeOptions& options);
  ~PrintEquilibria();
  PrintEquilibria(const PrintEquilibria&) = delete;
  PrintEquilibria& operator=(const PrintEquilibria&) = delete;

  Eigen::Index hinges() const;
  /// The equilibrium of the design.
  const State& design() const;
  /// One for each; not tried once the options say stop.
  std::vector<Print> of(const std::vector<Eigen::Matrix4Xd>& errors);

 private:
  struct Workers;
  std::unique_ptr<Workers> workers_;
};

}  // namespace kinetix::model
