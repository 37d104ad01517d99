#pragma once

#include <set>

#include "app/studio/play/frame.hpp"
#include "app/studio/play/shape.hpp"

namespace kinetix::app::studio {

/// The shape of a design at the moment: on its exact way, in equilibrium, or in the engine.
class Player {
 public:
  /// Bodies are at rest: their way is not known yet.
  explicit Player(const Design& design);

  /// Another design, folded as far as the one before. Where it has no exact motion, the mode is equilibrium until one
  /// comes that has; bodies that are not cut yet begin with their exact motion. Where that fails for want of memory the
  /// design before stays, but for a failure of the engine, which is left.
  void load(const Design& design);
  const Moving& moving() const { return *moving_; }
  /// The way of that hinge; it stays as far turned as it was.
  void take(std::shared_ptr<const BodiesWay> way) { moving_->take(std::move(way)); }
  /// What bodies collide with, cut to convex pieces.
  void take(std::shared_ptr<const sim::ContactParts> parts,
            std::shared_ptr<const model::ConvexBodies> pressing) {
    moving_->parts = std::move(parts);
    moving_->pressing = std::move(pressing);
  }
  Mode mode() const { return mode_; }
  /// Changes how the shape is computed; it stays as near as the mode has it.
  /// @pre bodies have their parts for all but exact   @throws InvalidInput for exact where the design does not move exactly
  void enter(Mode mode);

  /// Folds to theta, rad: exact at once, bullet by the design's drive, whose springs of shape memory turn springs() on. An
  /// equilibrium comes by show_equilibrium(). Theta is that of the design's own drive (LinkageDrive::theta) in all but exact.
  void fold_to(double theta);
  /// @throws InvalidInput where the mode is not equilibrium
  void show_equilibrium(const model::State& state, double theta, double force_N, double energy_Nmm);

  /// The hands of the page. @param at rest place of a point of the body, mm   @param to mm
  void drag(int body, const Eigen::Vector3d& at, const Eigen::Vector3d& to);
  void push(int body, const Eigen::Vector3d& at, double force_N);
  void fix(int body, bool fixed);
  void release();
  /// Flat, or at rest, nothing fixed.
  void reset();
  void set_gravity(bool on);
  /// @throws InvalidInput for bodies, whose hinges turn freely in the engine
  void set_springs(bool on);
  void set_paused(bool on) { paused_ = on; }
  void set_speed(double factor) { speed_ = factor; }
  void step();

  /// Whether the engine has anything to do.
  bool plays() const;
  /// Goes on in the engine as far as time has gone on since the last call.
  void play();

  double theta() const;        ///< rad, as fold_to() takes it
  double drive_theta() const;  ///< rad: of the design's own drive, in all modes
  double sheet_theta() const;  ///< rad: as far as the shape is folded, whatever drives it
  const model::State& state() const { return state_; }
  /// Without revision and hearers.
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
  bool has_drive_of_its_own() const;
  double kept_by_springs() const;
  double drive_theta(double theta, const model::State& state) const;
  sim::LiveSheet& engine();

  Design design_;
  std::unique_ptr<Moving> moving_;
  Mode wanted_ = Mode::exact, mode_ = Mode::exact;  ///< the one asked for; the one that the design allows
  double theta_ = 0;                                ///< rad, of exact and equilibrium
  bool is_awaited_ = false;  ///< the equilibrium at theta_: none of the design was shown yet
  double kept_ = 1;          ///< kept_by_springs() of the design
  model::State state_;
  double force_N_, energy_Nmm_;
  std::unique_ptr<sim::LiveSheet> live_;  ///< of bullet alone; after moving_, which it looks at
  std::set<int> fixed_;
  bool paused_ = false, gravity_ = false, springs_ = false;  ///< as asked for
  double speed_ = 1;
  PlayTime time_;
};

}  // namespace kinetix::app::studio
