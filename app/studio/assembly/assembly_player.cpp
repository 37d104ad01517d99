#include "app/studio/assembly/assembly_player.hpp"

#include <algorithm>

#include "model/base/invalid_input.hpp"
#include "model/closure/closure_drive.hpp"
#include "model/linkage/make_drive.hpp"

namespace kinetix::app::studio {
namespace {

int driven_of(const AssemblyFile& file, const model::Linkage& linkage) {
  return file.driven ? *file.driven : std::max(0, first_motion(linkage).fastest);
}

sim::PhysicsOptions live_options(const model::Assembly& assembly) {
  sim::PhysicsOptions options;
  options.step_s = live_step_s;
  double reach = assembly.edge_mm;
  for (const model::AssemblyHinge& h : assembly.hinges) reach = std::min(reach, h.reach_mm);
  options.reach = reach / assembly.edge_mm;
  return options;
}

}  // namespace

AssemblyPlayer::AssemblyPlayer(AssemblyFile file)
    : file_(std::move(file)), linkage_(linkage_of(file_.assembly)) {
  drive_by(driven_of(file_, linkage_));
}

void AssemblyPlayer::drive_by(int hinge) {
  way_ = way_at_rest(linkage_, hinge);
  reset();
}

void AssemblyPlayer::enter_exact() {
  if (mode_ == Mode::exact) return;
  const double turn = way_.pulled ? turn_ : hinge_turn(linkage_, state_, driven());
  live_.reset();
  mode_ = Mode::exact;
  turn_to(turn);
}

void AssemblyPlayer::enter_engine(std::shared_ptr<const sim::ContactParts> parts) {
  if (mode_ == Mode::bullet) return;
  mode_ = Mode::bullet;
  live_ = std::make_unique<sim::LiveSheet>(linkage_, live_options(file_.assembly), 1, std::move(parts));
  place_in_engine();
}

void AssemblyPlayer::place_in_engine() {
  live_->set_gravity(gravity_);
  live_->place(state_);
  for (const int body : fixed_) live_->fix(body, true);
  time_.restart();
}

void AssemblyPlayer::turn_to(double turn) {
  turn_ = std::clamp(turn, way_.least_turn(), way_.most_turn());
  state_ = state_at(linkage_, way_, turn_);
}

void AssemblyPlayer::fold_to(double theta) {
  const double turn = model::turn_at_theta(turn_sign(), theta);
  if (!live_) return turn_to(turn);
  if (way_.pulled)
    throw InvalidInput("theta: bodies of this design are pulled; in the physics they go by hand");
  const double reached = std::clamp(turn, way_.least_turn(), way_.most_turn());
  live_->drive_to(model::turned_hinge(driven(), turn_sign(), reached), state_);
}

void AssemblyPlayer::drag(int body, const Eigen::Vector3d& at, const Eigen::Vector3d& to) {
  if (live_) return live_->drag(body, at, to);
  turn_to(nearest_turn(linkage_, way_, turn_, body, at, to));
}

void AssemblyPlayer::fix(int body, bool on) {
  if (on)
    fixed_.insert(body);
  else
    fixed_.erase(body);
  if (live_) live_->fix(body, on);
}

void AssemblyPlayer::release() {
  if (live_) live_->release();
}

void AssemblyPlayer::reset() {
  if (live_)
    for (const int body : fixed_) live_->fix(body, false);
  fixed_.clear();
  turn_ = 0;
  state_ = rest_state(linkage_);
  if (live_) place_in_engine();
}

void AssemblyPlayer::set_gravity(bool on) {
  gravity_ = on;
  if (live_) live_->set_gravity(on);
}

void AssemblyPlayer::step() {
  if (!live_) throw InvalidInput("this needs the physics: mode bullet");
  live_->step();
  state_ = live_->state();
}

bool AssemblyPlayer::plays() const { return live_ && !paused_ && (gravity_ || !live_->is_at_rest()); }

void AssemblyPlayer::play() {
  time_.pass(
      speed_, [this] { return plays(); }, [this] { step(); });
}

double AssemblyPlayer::theta() const {
  return theta_at(live_ && !way_.pulled ? hinge_turn(linkage_, state_, driven()) : turn_);
}

Frame AssemblyPlayer::frame() const {
  Frame frame;
  frame.mode = mode_;
  frame.theta = theta();
  frame.state = state_;
  frame.seconds = live_ ? live_->seconds() : 0;
  return frame;
}

}  // namespace kinetix::app::studio
