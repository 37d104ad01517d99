#pragma once

#include <optional>

#include "model/elastic/elastic_system.hpp"
#include "model/lattice/lattice.hpp"
#include "model/lattice/square/family/drive.hpp"

namespace kinetix::optim {

/// A planar panel with elastic hinges between plates, its walls in contact, that is in equilibrium again
/// after each change of where its hinges sit and of how far the plates press: from the
/// equilibrium before where that leads to one nearby, else along the path from flat.
class PanelEquilibrium {
 public:
  /// @pre all hinges stand upright; elasticity and plates are valid
  /// @throws InvalidInput for walls that overlap in the flat state
  PanelEquilibrium(model::Lattice panel, const model::Elasticity& elasticity, const model::Plates& plates);

  /// @param t of every hinge, in (0, 1)   @param offset of every hinge, cell edges; empty: they stay   @return whether a stable equilibrium at the drive's goal was found;
  /// the state stays as it was where not
  bool settle(const Eigen::VectorXd& t, const Eigen::VectorXd& offset = {});
  /// How far the plates are to press from the next settle() on, (0, 1).
  void press(double compression) { drive_.compression = compression; }
  /// The next settle() starts from the state as it is. What it comes to depends on the state kept, not on
  /// others that were tried since. @pre settle() returned true
  void keep() { kept_ = state_; }
  /// The next settle() starts from flat.
  void forget() { kept_.clear(); }

  const model::Lattice& panel() const { return panel_; }
  const model::Plates& plates() const { return drive_; }
  /// @pre settle() returned true
  const model::State& state() const { return state_; }  ///< mm

  struct Gradient {
    Eigen::VectorXd t;       ///< one entry a hinge, per unit of t (a fraction)
    Eigen::VectorXd offset;  ///< one entry a hinge, per cell edge
    double compression = 0;  ///< per unit of compression (a fraction)
  };
  /// The derivatives of a function of the state, by the adjoint. @param by_state 6 a body, as
  /// EquilibriumGradient::state   @return without what the function has of the hinges directly, which is the
  /// caller's to add. Nothing where the equilibrium is singular
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
