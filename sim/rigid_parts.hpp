#pragma once

#include "model/linkage/state.hpp"
#include "sim/joints/row_system.hpp"
#include "sim/physics_options.hpp"
#include "sim/shapes/part_shape.hpp"

class btRigidBody;

namespace kinetix::sim {

struct ContactParts;

/// Bodies of a structure in the engine, and their motion. Units: cell edge 1, part mass 1, s.
///
/// The quasi-static result depends on neither mass nor inertia, so those are chosen for the solver: equal
/// masses, the same inertia about every axis, centre of mass on the vertex.
class RigidParts {
 public:
  static constexpr double mass = 1;  ///< of every part, the unit of mass

  /// @param structure must outlive this
  /// @param parts collision shapes of the bodies; null: their walls
  RigidParts(const model::Linkage& structure, const PhysicsOptions& options,
             const ContactParts* parts = nullptr);
  ~RigidParts();

  /// Returns the bodies in the structure's order; their user indices are their indices in it.
  const std::vector<std::unique_ptr<btRigidBody>>& bodies() const { return bodies_; }

  /// Adds turning speeds that move theta away from flat: +rate about z for sublattice A, -rate for B.
  /// @param rate rad/s
  void push(double rate);
  /// Adds a motion to the bodies' speeds. @param motion one twist per body, v in cell edges; @param rate 1/s
  void start(const std::vector<model::Twist>& motion, double rate);
  /// Multiplies all speeds. @param factor in [0, 1]
  void damp(double factor);

  /// Sets the state of all bodies, at rest. @param state mm
  void place(const model::State& state);

  model::State state() const;  ///< mm
  /// Returns linear and angular speed of each body, edges/s and rad/s.
  std::vector<Vector6> speeds() const;
  /// Returns the largest speed or turning speed, edges/s or rad/s; NaN if one is NaN.
  double fastest() const;
  /// Returns the largest relative turning speed of two parts that share a hinge, rad/s; NaN if one is NaN.
  double fastest_hinge() const;
  double kinetic_energy() const;  ///< part mass edge^2 / s^2.
  /// Returns the largest change of momentum, or of angular momentum over the cell edge, since the parts had
  /// these speeds, part mass edge / s; NaN if one is NaN.
  double largest_change(const std::vector<Vector6>& speeds_before) const;

 private:
  void add(PartShape shape, const PhysicsOptions& options);
  void add_walls(const PhysicsOptions& options);
  void add_pieces(const ContactParts& parts, const PhysicsOptions& options);

  const model::Linkage& structure_;
  const double inertia_;
  std::vector<PartShape> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

/// Returns the contact method. It is sharp if elastic walls stay upright, since contacts then press deep.
WallSurface wall_surface(const PhysicsOptions& options);

}  // namespace kinetix::sim
