#pragma once

#include <set>

#include "app/studio/play/page_updates.hpp"
#include "app/studio/play/shape.hpp"

namespace kinetix::app::studio {

/// Present shape of a design: on its exact path, in equilibrium, or in the engine.
class Player {
 public:
  /// Shows the design at its theta. The motion of bodies is not known yet, and they are at rest.
  explicit Player(const Design& design);

  /// Loads another design at the fold of the one before. A design without exact motion switches to
  /// equilibrium until one with exact motion is loaded. Bodies without convex pieces start in their exact
  /// motion.
  /// If memory runs out, the design before stays. If the engine fails, the mode changes to exact or
  /// equilibrium.
  void load(const Design& design);
  const Moving& moving() const { return *moving_; }
  /// Sets the known motion of the turned hinge. Its turn does not change.
  void take(std::shared_ptr<const BodiesMotion> motion) { moving_->take(std::move(motion)); }
  /// Sets the convex pieces for collisions of bodies.
  void take(std::shared_ptr<const sim::ContactParts> parts,
            std::shared_ptr<const model::ConvexBodies> pressing) {
    moving_->parts = std::move(parts);
    moving_->pressing = std::move(pressing);
  }
  Mode mode() const { return mode_; }
  /// Changes how the shape is computed, and keeps the shape as near as the mode allows.
  /// @pre bodies have their parts, except for exact   @throws InvalidInput for exact if the design has no
  /// exact motion
  void enter(Mode mode);

  /// Folds to theta, rad. Exact mode folds at once; bullet uses the design's drive, and shape-memory springs
  /// turn springs() on. In equilibrium mode show_equilibrium() must follow. Theta belongs to the design's
  /// drive (LinkageDrive::theta) except in exact mode.
  void fold_to(double theta);
  /// @throws InvalidInput if the mode is not equilibrium
  void show_equilibrium(const model::State& state, double theta, double force_N, double energy_Nmm);

  /// Moves a body by the page's pointer. @param at rest place of a point of the body, mm   @param to mm
  void drag(int body, const Eigen::Vector3d& at, const Eigen::Vector3d& to);
  void push(int body, const Eigen::Vector3d& at, double force_N);
  void fix(int body, bool fixed);
  void release();
  /// Returns to the flat or rest state, with nothing fixed.
  void reset();
  void set_gravity(bool on);
  /// @throws InvalidInput for bodies, whose hinges turn freely in the engine
  void set_springs(bool on);
  void set_paused(bool on) { paused_ = on; }
  void set_speed(double factor) { speed_ = factor; }
  void step();

  /// Returns whether the engine has work to do.
  bool plays() const;
  /// Advances the engine by the time since the last call.
  void play();

  double theta() const;        ///< rad, as set by fold_to()
  double drive_theta() const;  ///< rad: of the design's drive, in all modes
  double sheet_theta() const;  ///< rad: fold of the shape, independent of the drive
  const model::State& state() const { return state_; }
  /// Returns the shape without revision and `heard`.
  Frame frame() const;
  bool paused() const { return paused_; }
  bool gravity() const { return gravity_; }
  bool springs() const { return !moving_->bodies && (springs_ || !moving_->exact); }
  double speed() const { return speed_; }
  bool driven() const { return live_ && live_->is_driven(); }
  const std::set<int>& fixed() const { return fixed_; }

 private:
  void enter_engine(std::optional<double> driven = {});
  void drive_engine(double theta);
  bool has_custom_drive() const;
  double kept_by_springs() const;
  double drive_theta(double theta, const model::State& state) const;
  sim::LiveSheet& engine();

  Design design_;
  std::unique_ptr<Moving> moving_;
  Mode wanted_ = Mode::exact, mode_ = Mode::exact;  ///< requested mode; mode that the design allows
  double theta_ = 0;                                ///< rad, in exact and equilibrium mode
  bool is_awaited_ = false;  ///< equilibrium at theta_ was not shown since the design was loaded
  double kept_ = 1;          ///< kept_by_springs() of the design
  model::State state_;
  double force_N_, energy_Nmm_;
  std::unique_ptr<sim::LiveSheet> live_;  ///< bullet mode only; declared after moving_, which it uses
  std::set<int> fixed_;
  bool paused_ = false, gravity_ = false, springs_ = false;  ///< as requested
  double speed_ = 1;
  PlayTime time_;
};

}  // namespace kinetix::app::studio
