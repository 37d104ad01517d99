#include "app/studio/play/player.hpp"

#include "app/pipeline/drive_loads.hpp"
#include "app/pipeline/physics.hpp"
#include "model/closure/drive_theta.hpp"

namespace kinetix::app::studio {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double folded = 0.01;        // rad of theta: nearer to flat, the engine needs no drive
constexpr double typical_rest = 0.35;  // rad of theta: typical rest angle of shape-memory springs

}  // namespace

Player::Player(const Design& design) : force_N_(nan), energy_Nmm_(nan) {
  springs_ = design.hinge.model == HingeSection::Model::elastic;
  load(design);
  fold_to(design.theta);
}

void Player::load(const Design& design) {
  const double theta = theta_;
  auto moving = std::make_unique<Moving>(design);
  if (moving_) moving->keep(*moving_);
  Design taken = design;
  live_.reset();
  design_ = std::move(taken);
  moving_ = std::move(moving);
  kept_ = kept_by_springs();
  fixed_.clear();
  theta_ = moving_->within(theta);
  const bool has_no_equilibrium = body_pull_of(design) && wanted_ == Mode::equilibrium;
  if (moving_->bodies && (!moving_->parts || has_no_equilibrium)) wanted_ = Mode::exact;
  mode_ = wanted_ == Mode::exact && !moving_->exact ? Mode::equilibrium : wanted_;
  is_awaited_ = !moving_->exact;
  state_ = moving_->exact ? moving_->exact.at(theta_) : rest_state(moving_->linkage);
  force_N_ = energy_Nmm_ = nan;
  if (mode_ == Mode::bullet) enter_engine();
}

void Player::enter(Mode mode) {
  if (mode == Mode::exact && !moving_->exact)
    throw InvalidInput("exact: this design is not a one-degree-of-freedom mechanism: " + moving_->exact.why);
  wanted_ = mode;
  if (mode == mode_) return;
  const auto driven = mode_ == Mode::equilibrium ? std::optional(theta_) : std::nullopt;
  theta_ = sheet_theta();
  force_N_ = energy_Nmm_ = nan;
  is_awaited_ = false;
  live_.reset();
  mode_ = mode;
  if (mode == Mode::exact) fold_to(theta_);
  if (mode == Mode::equilibrium) theta_ = drive_theta(theta_, state_);
  if (mode == Mode::bullet) enter_engine(driven);
}

/// Returns whether the drive's theta differs from the sheet's.
bool Player::has_custom_drive() const {
  return design_.drive && !std::holds_alternative<model::Plates>(*design_.drive) && !body_pull_of(design_);
}

double Player::sheet_theta() const {
  const bool is_known =
      mode_ == Mode::exact || (mode_ == Mode::equilibrium && (is_awaited_ || !has_custom_drive()));
  const bool is_pulled = moving_->motion && moving_->motion->pulled;
  return is_known || is_pulled ? theta_ : moving_->theta_of(state_);
}

/// Returns the theta (rad) of the drive that holds `state`, whose sheet theta is `theta`.
double Player::drive_theta(double theta, const model::State& state) const {
  if (!has_custom_drive()) return theta;
  return model::theta_in(drive_of(design_), moving_->linkage, state) / kept_;
}

/// Returns the sheet's theta over the rest theta of shape-memory springs. Hinges resist the springs; the
/// ratio is about the same at all rest angles.
double Player::kept_by_springs() const {
  if (!has_custom_drive() || !moving_->exact) return 1;
  const model::LinkageDrive drive = drive_of(design_);
  if (drive.is_external()) return 1;
  const model::Elasticity elasticity = elasticity_of(design_);
  const double kept =
      exact_theta({moving_->linkage, drive.to(typical_rest), moving_->exact}, elasticity) / typical_rest;
  return kept > 0 ? kept : 1;
}

/// @param driven theta of the drive that holds the present state, if known
void Player::enter_engine(std::optional<double> driven) {
  const double at = moving_->theta_of(state_);
  try {
    live_ = live_sheet(design_, *moving_, springs());
    live_->set_gravity(gravity_);
    live_->place(state_);
    for (const int body : fixed_) live_->fix(body, true);
    time_.restart();
    if (springs() && std::abs(at) > folded) drive_engine(driven ? *driven : drive_theta(at, state_));
  } catch (...) {
    live_.reset();
    mode_ = wanted_ = moving_->exact ? Mode::exact : Mode::equilibrium;
    throw;
  }
}

void Player::drive_engine(double theta) {
  if (moving_->bodies) return live_->drive_to(moving_->turned(theta), state_);
  const model::LinkageDrive drive = drive_to(design_, theta);
  if (!drive.is_external() && !springs()) set_springs(true);
  const model::State reference = moving_->exact ? moving_->exact.at(sheet_theta()) : state_;
  live_->drive_to(drive, reference);
}

sim::LiveSheet& Player::engine() {
  if (live_) return *live_;
  throw InvalidInput("this command needs the simulation. Send mode bullet first");
}

void Player::fold_to(double theta) {
  if (mode_ == Mode::bullet) return drive_engine(theta);
  theta_ = moving_->within(theta);
  if (mode_ == Mode::exact) state_ = moving_->exact.at(theta_);
}

void Player::show_equilibrium(const model::State& state, double theta, double force_N, double energy_Nmm) {
  if (mode_ != Mode::equilibrium) return;
  is_awaited_ = false;
  state_ = state;
  theta_ = theta;
  force_N_ = force_N;
  energy_Nmm_ = energy_Nmm;
}

void Player::drag(int body, const Eigen::Vector3d& at, const Eigen::Vector3d& to) {
  if (mode_ == Mode::bullet) return live_->drag(body, at, to);
  if (!moving_->exact)
    throw InvalidInput("drag: the design has no analytic motion. Use the simulation, or the fold slider");
  const double nearest = nearest_theta(*moving_, sheet_theta(), body, at, to);
  fold_to(mode_ == Mode::equilibrium ? drive_theta(nearest, moving_->exact.at(nearest)) : nearest);
}

void Player::push(int body, const Eigen::Vector3d& at, double force_N) {
  const model::Linkage& linkage = moving_->linkage;
  const Eigen::Vector3d arm = at - linkage.rest_position(body);
  const model::Plate* nearest = nullptr;
  double least = 0;
  for (const model::Plate& plate : linkage.plates) {
    if (plate.body != body) continue;
    const double along = arm.dot(plate.edge);
    if (!nearest || along > least) nearest = &plate, least = along;
  }
  if (!nearest) throw InvalidInput("body: has no plate to push on");
  engine().push(body, at, force_N * nearest->edge.cross(nearest->up));
}

void Player::fix(int body, bool on) {
  if (on)
    fixed_.insert(body);
  else
    fixed_.erase(body);
  if (live_) live_->fix(body, on);
}

void Player::release() {
  if (live_) live_->release();
}

void Player::reset() {
  fixed_.clear();
  theta_ = 0;
  state_ = rest_state(moving_->linkage);
  force_N_ = energy_Nmm_ = nan;
  if (mode_ == Mode::exact) state_ = moving_->exact.at(0);
  if (live_) enter_engine();
}

void Player::set_gravity(bool on) {
  gravity_ = on;
  if (live_) live_->set_gravity(on);
}

void Player::set_springs(bool on) {
  if (moving_->bodies) throw InvalidInput("springs: hinges of bodies turn freely in the simulation");
  springs_ = on;
  if (live_) enter_engine();
}

void Player::step() {
  engine().step();
  state_ = live_->state();
}

bool Player::plays() const { return live_ && !paused_ && (gravity_ || !live_->is_at_rest()); }

void Player::play() {
  time_.pass(
      speed_, [this] { return plays(); }, [this] { step(); });
}

double Player::drive_theta() const { return mode_ == Mode::exact ? drive_theta(theta_, state_) : theta(); }

double Player::theta() const { return mode_ == Mode::bullet ? drive_theta(sheet_theta(), state_) : theta_; }

Frame Player::frame() const {
  Frame frame;
  frame.mode = mode_;
  frame.theta = theta();
  frame.state = state_;
  frame.force_N = live_ ? live_->pull_force_N() : force_N_;
  frame.energy_Nmm = live_ ? live_->hinge_energy_Nmm() : energy_Nmm_;
  frame.seconds = live_ ? live_->seconds() : 0;
  return frame;
}

}  // namespace kinetix::app::studio
