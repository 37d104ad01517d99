#pragma once

#include <optional>

#include "model/elastic/elastic_system.hpp"
#include "model/lattice/lattice.hpp"
#include "model/lattice/square/family/drive.hpp"

namespace kinetix::optim {

/// Equilibrium of a planar panel with elastic hinges between plates, its walls in contact. It is found again
/// after each change of the hinges' places or of the compression. The search starts from the last equilibrium
/// and falls back to the path from flat if no nearby one is found.
class PanelEquilibrium {
 public:
  /// @pre all hinges are perpendicular to the plane; elasticity and plates are valid
  /// @throws InvalidInput for walls that overlap in the flat state
  PanelEquilibrium(model::Lattice panel, const model::Elasticity& elasticity, const model::Plates& plates);

  /// Finds the equilibrium for these hinges. The state is unchanged on failure.
  /// @param t of every hinge, in (0, 1)
  /// @param offset of every hinge, cell edges; empty: unchanged
  /// @return whether a stable equilibrium at the drive's goal was found
  bool settle(const Eigen::VectorXd& t, const Eigen::VectorXd& offset = {});
  /// Sets the compression of the plates from the next settle() on, (0, 1).
  void press(double compression) { drive_.compression = compression; }
  /// Makes the next settle() start from the present state. Its result then depends on this state only, not on
  /// other states tried since. @pre settle() returned true
  void keep() { kept_ = state_; }
  /// Makes the next settle() start from flat.
  void forget() { kept_.clear(); }

  const model::Lattice& panel() const { return panel_; }
  const model::Plates& plates() const { return drive_; }
  /// @pre settle() returned true
  const model::State& state() const { return state_; }  ///< mm

  struct Gradient {
    Eigen::VectorXd t;       ///< one entry per hinge, per unit of t (a fraction)
    Eigen::VectorXd offset;  ///< one entry per hinge, per cell edge
    double compression = 0;  ///< per unit of compression (a fraction)
  };
  /// Returns the derivatives of a function of the state, by the adjoint. Direct derivatives of the function
  /// by the hinges are not included; the caller adds them. Returns nullopt if the equilibrium is singular.
  /// @param by_state 6 per body, as EquilibriumGradient::state
  std::optional<Gradient> gradient(const Eigen::VectorXd& by_state);

  int paths_from_flat() const { return paths_; }

 private:
  bool settle_nearby();
  bool settle_from_flat();
  model::LinkageDrive plates_on_panel() const;

  model::Lattice panel_;
  model::Elasticity elasticity_;
  model::Plates drive_;
  model::State state_, kept_;
  int paths_ = 0;
};

}  // namespace kinetix::optim
