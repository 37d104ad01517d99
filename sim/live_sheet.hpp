#pragma once

#include "model/linkage/linkage_drive.hpp"
#include "sim/physics_options.hpp"

namespace kinetix::sim {

class World;
struct ContactParts;

/// Structure in the engine for interactive use. The user can drag, hold, push and drive it, one time step
/// after the other.
///
/// Hinges are those of a compression run, rigid or elastic. All parts have the same mass, which makes motions
/// look natural but says nothing about real speeds. With elastic hinges, forces and energies are those of the
/// material. Motion is damped. Without pull, push or drive, the sum of kinetic energy and that of hinges and
/// weight never grows. Energy that a step adds by closing gaps is removed from its speeds. One structure at a
/// time per thread.
class LiveSheet {
 public:
  /// @param structure must outlive this.
  /// @param options step_s is the length of a step().
  /// @param k_point_N_mm stiffness of elastic hinges, the unit of options.elastic.
  /// @param parts collision shapes of the bodies; null: their walls.
  LiveSheet(const model::Linkage& structure, const PhysicsOptions& options, double k_point_N_mm,
            std::shared_ptr<const ContactParts> parts = nullptr);
  ~LiveSheet();

  /// Sets the state, at rest. Ends dragging, pushing and driving; held bodies are held at their new places.
  /// @param state mm
  void place(const model::State& state);
  /// Pulls a point of a body towards a place by a spring. @param at rest position of the point, mm;
  /// @param to mm
  void drag(int body, const Eigen::Vector3d& at, const Eigen::Vector3d& to);
  /// Pushes on a point of a body. With rigid hinges there is no unit of force: 1 N then moves a part by 15
  /// cell edges in a second.
  /// @param at rest position of the point, mm; @param force_N with fixed direction in the body's rest frame
  void push(int body, const Eigen::Vector3d& at, const Eigen::Vector3d& force_N);
  /// Ends dragging, pushing and driving.
  void release();
  /// Holds a body at its present place, or releases it.
  void fix(int body, bool fixed);
  /// Switches weight on or off. It acts along -z and is as large as needed to turn a sheet over.
  void set_gravity(bool on) { gravity_ = on; }
  /// Drives from the present state towards theta. Plates move the structure as a whole to their place. A tendon
  /// that is already shorter pulls nothing. Shape memory needs elastic hinges.
  /// @param drive with its goal.
  /// @param reference state near the present one that the drive would reach from flat, mm
  void drive_to(const model::LinkageDrive& drive, const model::State& reference);

  void step();

  const model::State& state() const { return state_; }  ///< mm
  double seconds() const { return seconds_; }           ///< simulated time
  bool is_driven() const { return drive_.has_value(); }
  bool is_dragged() const;
  /// Returns whether nothing pulls, pushes or drives it and no part moves by more than 1e-4 cell edges or rad
  /// per second.
  bool is_at_rest() const;
  /// Returns the force of the dragging hand, N; NaN without dragging or with rigid hinges.
  double pull_force_N() const;
  /// Returns the energy in elastic hinges, N mm; NaN with rigid hinges.
  double hinge_energy_Nmm() const;
  /// Returns the sum of kinetic energy and the energy in hinges and of weight: part mass edge^2 / s^2.
  double energy() const;

 private:
  struct Push {
    int body;
    Eigen::Vector3d arm, force;  ///< in the rest frame: cell edges, and part mass edge / s^2
  };

  void rebuild();
  void stand_between_plates(const model::State& reference);
  void advance_drive();
  void apply_forces();
  void leave_flat();
  void limit_energy(double before);
  bool holds(const model::State& next) const;
  void accept(double before);
  bool is_pulled() const { return is_dragged() || push_ || drive_; }
  double potential(const model::State& state) const;  ///< energy in hinges, k_point edge^2
  double potential_energy(const model::State& state) const;
  double force_unit() const;

  const model::Linkage& structure_;
  const PhysicsOptions options_;
  const double k_point_;
  const std::shared_ptr<const ContactParts> parts_;
  std::unique_ptr<World> world_;
  std::optional<model::LinkageDrive> drive_;
  std::optional<Push> push_;
  bool gravity_ = false;
  double theta_ = 0;   ///< of the drive, rad
  double step_limit_;  ///< longest motion of a part per step: cell edges or rad
  double seconds_ = 0;
  model::State state_;
};

}  // namespace kinetix::sim
