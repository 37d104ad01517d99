#pragma once

#include "model/elastic/path/equilibrium_path.hpp"

namespace kinetix::model {

/// Elastic system of a driven linkage with its tangent stiffness. It converts results to N and mm.
struct MeasuredSystem {
  /// @throws InvalidInput, with contact, for walls that overlap in the flat state
  /// @pre elasticity, drive and options are valid
  MeasuredSystem(const Linkage& linkage, const Elasticity& elasticity, const LinkageDrive& drive,
                 const EquilibriumPathOptions& options);
  MeasuredSystem(const MeasuredSystem&) = delete;  // the tangent refers to the system
  MeasuredSystem& operator=(const MeasuredSystem&) = delete;

  /// Returns whether flat is singular under the drive: its coordinate changes with theta squared, for either
  /// side.
  bool has_branch_at_flat() const { return elastic.drive().has_branch(); }
  /// Returns the step data of a state in equilibrium at theta, rad. @pre if stable, `tangent` is its tangent,
  /// factorised
  EquilibriumStep measured(const State& state, double theta, bool stable) const;
  /// Returns the energy of each hinge, N mm.
  std::vector<HingeEnergy> hinge_energies(const State& state) const;

  const bool planar;  ///< bodies move in the plane z = 0 only
  const double unit;  ///< of energies, in N mm
  ElasticSystem elastic;
  TangentStiffness tangent;  ///< of the last state at which `elastic` was linearised
};

}  // namespace kinetix::model
