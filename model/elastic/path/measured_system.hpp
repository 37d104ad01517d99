#pragma once

#include "model/elastic/path/equilibrium_path.hpp"

namespace kinetix::model {

/// The elastic system of a driven linkage with its tangent stiffness, and what its states measure in N and
/// mm.
struct MeasuredSystem {
  /// @throws InvalidInput, with contact, for walls that overlap in the flat state
  /// @pre elasticity, drive and options are valid
  MeasuredSystem(const Linkage& linkage, const Elasticity& elasticity, const LinkageDrive& drive,
                 const EquilibriumPathOptions& options);
  MeasuredSystem(const MeasuredSystem&) = delete;  // the tangent refers to the system beside it
  MeasuredSystem& operator=(const MeasuredSystem&) = delete;

  /// Whether flat is singular under the drive, which comes closer with the square of theta to either side.
  bool leaves_flat_to_a_side() const { return elastic.drive().has_branch(); }
  /// A state of equilibrium at theta, rad. @pre if stable, `tangent` is its tangent, factorised
  EquilibriumStep measured(const State& state, double theta, bool stable) const;
  /// N mm, of each hinge.
  std::vector<HingeEnergy> hinge_energies(const State& state) const;

  const bool planar;  ///< bodies move in the plane z = 0 only
  const double unit;  ///< of the system's energies, N mm
  ElasticSystem elastic;
  TangentStiffness tangent;  ///< of the state that `elastic` was linearised at last
};

}  // namespace kinetix::model
