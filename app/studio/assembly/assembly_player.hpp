#pragma once

#include <memory>
#include <set>

#include "app/assembly/assembly_file.hpp"
#include "app/studio/assembly/assembly_way.hpp"
#include "app/studio/play/frame.hpp"
#include "app/studio/play/play_time.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "sim/contact_parts.hpp"
#include "sim/live_sheet.hpp"

namespace kinetix::app::studio {

/// The shape of a design of bodies at the moment: on its closed way, or in the engine.
class AssemblyPlayer {
 public:
  /// At rest, where its way is not known yet; the hinge that it says is turned, or that turns most in the first motion.
  explicit AssemblyPlayer(AssemblyFile file);

  const AssemblyFile& file() const { return file_; }
  const model::Linkage& linkage() const { return linkage_; }
  const AssemblyWay& way() const { return way_; }
  int driven() const { return way_.hinge; }
  /// At rest, with another hinge to turn whose way is not known yet.
  void drive_by(int hinge);
  /// The way of driven(); it stays as far turned as it was. @pre way.hinge == driven()
  void take(AssemblyWay way) { way_ = std::move(way); }

  Mode mode() const { return mode_; }
  void enter_exact();
  void enter_engine(std::shared_ptr<const sim::ContactParts> parts);

  /// Exact: at once, as far as the way goes; bullet: by the driven hinge. @param theta of the drive, rad: half its turn
  void fold_to(double theta);
  /// The hands of the page. @param at rest place of a point of the body, mm   @param to mm
  void drag(int body, const Eigen::Vector3d& at, const Eigen::Vector3d& to);
  void fix(int body, bool fixed);
  void release();
  /// At rest, nothing fixed.
  void reset();
  void set_gravity(bool on);
  void set_paused(bool on) { paused_ = on; }
  void set_speed(double factor) { speed_ = factor; }
  void step();

  /// Whether the engine has anything to do.
  bool plays() const;
  /// Goes on in the engine as far as time has gone on since the last call.
  void play();

  double theta() const;  ///< of the drive, rad
  double theta_at(double turn) const {
    return model::theta_at_turn(turn_sign(), turn);
  }  ///< rad of the driven hinge
  int turn_sign() const { return linkage_.bodies[linkage_.hinges[driven()].lower].sense; }
  /// Without revision and hearers.
  Frame frame() const;
  bool paused() const { return paused_; }
  bool gravity() const { return gravity_; }
  double speed() const { return speed_; }
  bool driven_now() const { return live_ && live_->is_driven(); }
  const std::set<int>& fixed() const { return fixed_; }

 private:
  void turn_to(double turn);
  void place_in_engine();

  AssemblyFile file_;
  model::Linkage linkage_;
  AssemblyWay way_;
  Mode mode_ = Mode::exact;
  double turn_ = 0;  ///< rad of the driven hinge, of exact
  model::State state_;
  std::unique_ptr<sim::LiveSheet> live_;  ///< of bullet alone; after linkage_, which it looks at
  std::set<int> fixed_;
  bool paused_ = false, gravity_ = false;
  double speed_ = 1;
  PlayTime time_;
};

}  // namespace kinetix::app::studio
