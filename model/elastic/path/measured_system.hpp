#pragma once

#include "model/elastic/elastic_system.hpp"
#include "model/elastic/path/equilibrium_path.hpp"

namespace kinetix::model {

/// Returns the derivative of a state by theta along its equilibrium path: all coordinates, rad and cell edges
/// per rad. It is zero for coordinates that the drive holds or moves itself (ElasticSystem::place_rate).
/// @param state in equilibrium at theta, rad.
/// @param tangent its tangent, factorised
/// @param placed_at theta, rad, for the speed of plates and tendons: in the flat state this speed is 0 to
///   first order
Eigen::VectorXd path_direction(const ElasticSystem& system, const State& state, double theta,
                               double placed_at, const TangentStiffness& tangent, int refined = 0);

/// Returns whether the turning springs are so soft that the load on the drive is below Newton's force
/// tolerance and rounding.
bool turns_softly(const ElasticSystem& system);

/// Returns the derivative of the elastic energy along the path by the drive's coordinate, in the units of
/// ElasticSystem::load. It equals the force on the driven part. Residual forces at the hinge points do no
/// work along the path. So the load of a one-degree-of-freedom sheet is accurate to the digits of its turning
/// springs, however soft they are.
/// @param state in equilibrium at theta, rad, not 0 for plates
/// @param tangent its tangent, factorised
double load_along_path(const ElasticSystem& system, const State& state, double theta,
                       const TangentStiffness& tangent);

/// Returns the derivative of the load by the drive's coordinate along the path, by central differences of
/// first-order states. In the units of ElasticSystem::load per unit of that coordinate. NaN for plates in the
/// flat state, and if rounding would dominate.
/// @param state in stable equilibrium at theta, rad
/// @param tangent its tangent, factorised
double load_stiffness(const ElasticSystem& system, const State& state, double theta,
                      const TangentStiffness& tangent);

/// Returns the load of an equilibrium: along the path if hinges turn softly, otherwise the force on the
/// driven part. For springs it is computed from their turns, which have no rounding problem.
/// @param state in equilibrium at theta, rad
/// @param tangent of the state; used and factorised only if `stable`
double drive_load(const ElasticSystem& system, const State& state, double theta,
                  const TangentStiffness& tangent, bool stable);

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
