#pragma once

#include <memory>
#include <optional>

#include "model/linkage/linkage_drive.hpp"
#include "sim/physics_options.hpp"

namespace kinetix::sim {

class World;
struct ContactParts;

/// A structure in the engine that somebody plays with: dragged, held, pushed, driven, one time step after the other.
///
/// Hinges are those of a compression run, rigid or elastic. Parts have the same mass, so that motions look right and
/// say nothing of how fast the thing is; with elastic hinges forces and energies are those of its material.
/// Motion dies away. Where nothing pulls, pushes or drives, kinetic energy and that of hinges and weight together
/// never grow: what a step would add by closing gaps is taken off its speeds. One structure at a time a thread.
class LiveSheet {
 public:
  /// @param structure must outlive this
  /// @param options step_s is that of a step()
  /// @param k_point_N_mm of elastic hinges, the unit of options.elastic
  /// @param parts what its bodies collide with; null: their walls
  LiveSheet(const model::Linkage& structure, const PhysicsOptions& options, double k_point_N_mm,
            std::shared_ptr<const ContactParts> parts = nullptr);
  ~LiveSheet();

  /// Puts the structure there, at rest; what is dragged, pushed and driven is let go, held bodies are held there.
  /// @param state mm
  void place(const model::State& state);
  /// Pulls a point of a body towards a place by a spring. @param at rest place of the point, mm; @param to mm
  void drag(int body, const Eigen::Vector3d& at, const Eigen::Vector3d& to);
  /// Pushes on a point of a body. @param at as above; @param force_N with fixed direction in the body's rest frame.
  /// With rigid hinges there is no unit of force: 1 N then moves a part by 15 cell edges in a second.
  void push(int body, const Eigen::Vector3d& at, const Eigen::Vector3d& force_N);
  /// Lets go of what is dragged, pushed and driven.
  void release();
  /// Holds a body where it is now, or lets it go.
  void fix(int body, bool fixed);
  /// Weight, as large as turns a sheet over, downwards along -z.
  void set_gravity(bool on) { gravity_ = on; }
  /// Drives from where it stands towards theta. @param drive with its goal; the structure may stand anywhere: plates move
  /// it as a whole to where they find it. A cord that is shorter already pulls nothing. Shape memory needs elastic hinges.
  /// @param reference the state near to the present one that the drive would have led to from flat, mm
  void drive_to(const model::LinkageDrive& drive, const model::State& reference);

  void step();

  const model::State& state() const { return state_; }  ///< mm
  double seconds() const { return seconds_; }           ///< simulated
  bool is_driven() const { return drive_.has_value(); }
  bool is_dragged() const;
  /// Nothing pulls, pushes or drives it, and no part moves by more than 1e-4 cell edges or rad a second.
  bool is_at_rest() const;
  /// Of the dragging hand, N; NaN where it does not drag, or hinges are rigid.
  double hand_force_N() const;
  /// In elastic hinges, N mm; NaN where they are rigid.
  double hinge_energy_Nmm() const;
  /// Kinetic energy, energy in hinges and of weight: part mass edge^2 / s^2.
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
  void keep_energy(double before);
  bool holds(const model::State& next) const;
  void accept(double before);
  bool is_pulled() const { return is_dragged() || push_ || drive_; }
  double potential(const model::State& state) const;  ///< in hinges, k_point edge^2
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
  double theta_ = 0;  ///< of the drive, rad
  double way_;        ///< longest of a part in a step: cell edges or rad
  double seconds_ = 0;
  model::State state_;
};

}  // namespace kinetix::sim
