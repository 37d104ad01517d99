#include "sim/physics_run.hpp"

#include <fmt/format.h>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>

#include "model/base/decompositions.hpp"
#include "model/base/invalid_input.hpp"
#include "model/closure/mobility.hpp"
#include "sim/joints/elastic_hinges.hpp"
#include "sim/joints/external_pulls.hpp"
#include "sim/rigid_parts.hpp"
#include "sim/world.hpp"

namespace kinetix::sim {
namespace {

using Clock = std::chrono::steady_clock;

// Part mass / s^2, of all springs of a body: it follows its target within a hundredth of the run's time.
constexpr double pull_stiffness = 1e3;

int whole_steps(double seconds, double step_s) {
  return std::max(1, static_cast<int>(std::ceil(seconds / step_s - 1e-9)));
}

class PullRun {
 public:
  PullRun(const model::Linkage& structure, const model::Pull& pull, const PhysicsOptions& options,
          const ContactParts& parts, const PhysicsObserver& observer)
      : structure_(structure),
        pull_(pull),
        options_(options),
        observer_(observer),
        drive_steps_(whole_steps(options.drive_seconds, options.step_s)),
        all_steps_(drive_steps_ + whole_steps(options.settle_seconds, options.step_s)),
        damping_(std::exp(-options.settle_damping * options.step_s)),
        world_(structure, std::nullopt, options, &parts) {}

  PhysicsResult run() {
    const auto begin = Clock::now();
    measure();
    bool settled = false;
    while (result_.steps < all_steps_ && !settled && !has_failed() && !observer_.stop.stop_requested()) {
      step();
      settled = result_.steps >= drive_steps_ && is_at_rest();
    }
    set_status(structure_, model::LinkageDrive(), options_, settled, result_);
    result_.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    if (observer_.progress) observer_.progress(1);
    return std::move(result_);
  }

 private:
  void step() {
    const double tau = std::min(1.0, (result_.steps + 1.0) / drive_steps_);
    set_pulls(model::pull_at(structure_, pull_, tau * (2 - tau)));
    world_.parts().damp(damping_);
    world_.step();
    ++result_.steps;
    measure();
    if (observer_.progress && result_.steps % std::max(1, all_steps_ / 100) == 0)
      observer_.progress(static_cast<double>(result_.steps) / (all_steps_ + 1));
  }

  void set_pulls(const model::Pull& now) {
    const std::vector<Eigen::Vector3d> arms = model::pull_points(now.turns);
    const double stiffness = pull_stiffness / static_cast<double>(arms.size());
    std::vector<SpringPull>& spring_pulls = world_.external_pulls().spring_pulls;
    spring_pulls.clear();
    for (int b = 0; b < static_cast<int>(now.to.size()); ++b)
      for (const Eigen::Vector3d& arm : arms)
        spring_pulls.push_back(
            {b, arm, now.to[b].p / structure_.size.edge_mm + now.to[b].R * arm, stiffness});
  }

  void measure() {
    result_.simulated_s = result_.steps * options_.step_s;
    result_.state = world_.parts().state();
    result_.gaps = hinge_gaps(structure_, result_.state);
    result_.contact = world_.deepest_contact();
  }

  bool is_at_rest() const {
    return world_.contacts_agree() && world_.parts().fastest_hinge() <= options_.settle_speed;
  }

  bool has_failed() {
    if (!(world_.parts().fastest() <= options_.speed_limit)) result_.status = PhysicsResult::Status::blew_up;
    return result_.status == PhysicsResult::Status::blew_up || !(result_.gaps.max <= options_.tear_limit) ||
           result_.contact.depth > overlap_limit(structure_, options_);
  }

  const model::Linkage& structure_;
  const model::Pull& pull_;
  const PhysicsOptions& options_;
  const PhysicsObserver& observer_;
  const int drive_steps_, all_steps_;
  const double damping_;
  World world_;
  PhysicsResult result_;
};

}  // namespace

PhysicsResult run_pull(const model::Linkage& structure, const model::Pull& pull,
                       const PhysicsOptions& options, const ContactParts& parts,
                       const PhysicsObserver& observer) {
  options.validate();
  if (options.elastic) throw InvalidInput("bodies can be pulled only if hinges are revolute joints");
  return PullRun(structure, pull, options, parts, observer).run();
}

namespace {

constexpr double min_share = 0.5;            // of the wanted spins: a motion with less is a different one
constexpr double weight_of_the_rest = 1e-6;  // relative to that of the spins: decides only what they leave
                                             // open

std::vector<model::Twist> bare_spins(const model::Linkage& structure) {
  std::vector<model::Twist> twists(structure.bodies.size());
  for (std::size_t b = 0; b < twists.size(); ++b) twists[b].omega = structure.bodies[b].first_turn();
  return twists;
}

/// Returns the internal motions as columns, then the six of the whole as a rigid body.
Eigen::MatrixXd all_motions(const model::Linkage& structure) {
  const Eigen::MatrixXd internal = null_space(structure, rest_state(structure)).basis;
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(6 * structure.bodies.size(), internal.cols() + 6);
  motions.leftCols(internal.cols()) = internal;
  for (std::size_t b = 0; b < structure.bodies.size(); ++b) {
    const Eigen::Vector3d r = structure.rest_position(static_cast<int>(b)) / structure.size.edge_mm;
    auto rigid = motions.block<6, 6>(6 * b, internal.cols());
    rigid.setIdentity();
    rigid.block<3, 3>(3, 0) << 0, r.z(), -r.y(), -r.z(), 0, r.x(), r.y(), -r.x(), 0;
  }
  return motions;
}

/// Finds the motion nearest to the wanted spins by least squares. Bodies that turn about z count with their z
/// part. Everything else is kept small if the spins leave a choice.
Eigen::VectorXd nearest_motion(const model::Linkage& structure, const Eigen::MatrixXd& motions) {
  Eigen::VectorXd weight = Eigen::VectorXd::Constant(motions.rows(), weight_of_the_rest);
  Eigen::VectorXd wanted = Eigen::VectorXd::Zero(motions.rows());
  for (std::size_t b = 0; b < structure.bodies.size(); ++b) {
    if (structure.bodies[b].spin) weight.segment<3>(6 * b).setOnes();
    weight[6 * b + 2] = 1;
    wanted.segment<3>(6 * b) = structure.bodies[b].first_turn();
  }
  const Eigen::MatrixXd weighted = weight.asDiagonal() * motions;
  return motions * SymmetricFactor(motions.transpose() * weighted).solve(weighted.transpose() * wanted);
}

}  // namespace

std::vector<model::Twist> start_motion(const model::Linkage& structure) {
  const Eigen::VectorXd motion = nearest_motion(structure, all_motions(structure));
  double share = 0, all = 0;
  for (std::size_t b = 0; b < structure.bodies.size(); ++b) {
    share += structure.bodies[b].first_turn().dot(motion.segment<3>(6 * b));
    all += structure.bodies[b].first_turn().squaredNorm();
  }
  share /= all;
  if (!(share > min_share)) return bare_spins(structure);
  std::vector<model::Twist> twists;
  for (std::size_t b = 0; b < structure.bodies.size(); ++b)
    twists.push_back({motion.segment<3>(6 * b) / share, motion.segment<3>(6 * b + 3) / share});
  return twists;
}

// Uses the generator's bits, since the distributions of the standard differ between libraries.
void disturb(std::vector<model::Twist>& motion, double by, unsigned seed, bool planar) {
  std::mt19937 random(seed);
  const auto part = [&] { return by * (2 * static_cast<double>(random()) / std::mt19937::max() - 1); };
  for (model::Twist& twist : motion) {
    const Eigen::Vector3d turn(part(), part(), part()), shift(part(), part(), part());
    twist.omega += planar ? Eigen::Vector3d(0, 0, turn.z()) : turn;
    twist.v += planar ? Eigen::Vector3d(shift.x(), shift.y(), 0) : shift;
  }
}

namespace {

constexpr int min_window_steps = 100;  // since the drive's end: fewer show too little of a slow swing
constexpr int window_steps = 200;     // time steps at the end: enough to show the amplitude of an oscillation
constexpr int few_steps = 8;          // downhill: a soft mode takes more
constexpr double least_force = 1e-9;  // k_point edge: below, a structure is at rest

int steps_in(double seconds, double step_s) { return static_cast<int>(std::ceil(seconds / step_s - 1e-9)); }

std::vector<model::Twist> first_motion(const model::Linkage& structure, const PhysicsOptions& options) {
  std::vector<model::Twist> motion = start_motion(structure);
  disturb(motion, options.disturbance, options.disturbance_seed, options.planar);
  return motion;
}

class Run {
 public:
  Run(const model::Linkage& structure, const model::LinkageDrive& drive, const PhysicsOptions& options,
      const PhysicsObserver& observer, const ContactParts* parts = nullptr)
      : structure_(structure),
        drive_(drive),
        options_(options),
        observer_(observer),
        theta_(drive.theta()),
        drive_steps_(std::max(1, steps_in(options.drive_seconds, options.step_s))),
        all_steps_(drive_steps_ + steps_in(options.settle_seconds, options.step_s)),
        rate_(theta_ / (drive_steps_ * options.step_s)),
        damping_(std::exp(-options.settle_damping * options.step_s)),
        start_(first_motion(structure, options)),
        world_(structure, drive, options, parts) {}

  PhysicsResult run() {
    const auto begin = Clock::now();
    world_.parts().start(start_, 2 * rate_);
    measure();
    show();
    bool settled = false, failed = failed_during_motion();
    while (result_.steps < all_steps_ && !settled && !failed && !observer_.stop.stop_requested()) {
      step();
      failed = failed_during_motion();
      settled = !failed && result_.steps >= drive_steps_ && (comes_to_rest() || stays_in_place());
    }
    set_status(structure_, drive_, options_, settled, result_);
    result_.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    show_end();
    return std::move(result_);
  }

 private:
  void step() {
    const double tau = std::min(1.0, (result_.steps + 1.0) / drive_steps_);
    if (result_.steps >= drive_steps_) calm();
    world_.parts().push(rate_ * (1 - tau) / drive_steps_);
    if (options_.elastic) world_.relax_along(start_, theta_ * tau * (2 - tau) * (1 - tau));
    world_.set_drive(theta_ * tau * (2 - tau));
    world_.slow_to_cord();
    world_.step();
    ++result_.steps;
    measure();
    show();
  }

  /// With elastic hinges, stops all parts once their kinetic energy decreases: they are past the deepest
  /// point of their path. With rigid hinges, damps all speeds.
  void calm() {
    if (!options_.elastic) return world_.parts().damp(damping_);
    const double energy = world_.parts().kinetic_energy();
    if (energy < energy_) {
      limit_motion();
      world_.parts().damp(0);
      energy_ = motion_ = steps_downhill_ = 0;
    } else {
      energy_ = energy;
      ++steps_downhill_;
      motion_ = std::max(motion_, world_.parts().fastest() * options_.step_s);
    }
  }

  /// Adapts the longest motion per step. A linearised step may overshoot the deepest point, and the next one
  /// overshoot back, without end. Parts move half as far from now on if they are past that point after a few
  /// steps, the longest of which was at least half of the previous longest. Otherwise the limit doubles.
  void limit_motion() {
    const bool jumps = steps_downhill_ <= few_steps && motion_ >= previous_motion_ / 2;
    max_motion_ = jumps ? motion_ / 2 : 2 * max_motion_;
    previous_motion_ = motion_;
    world_.limit_motion(max_motion_);
  }

  void measure() {
    result_.simulated_s = result_.steps * options_.step_s;
    result_.state = world_.parts().state();
    result_.gaps = hinge_gaps(structure_, result_.state);
    result_.drive_gap = world_.drive_gap();
    result_.contact = world_.deepest_contact();
  }

  bool failed_during_motion() {
    if (!(world_.parts().fastest() <= options_.speed_limit)) result_.status = PhysicsResult::Status::blew_up;
    return result_.status == PhysicsResult::Status::blew_up ||
           !(result_.gaps.max <= (options_.elastic ? options_.stretch_limit : options_.tear_limit)) ||
           is_blocked();
  }

  bool is_blocked() const {
    if (result_.contact.depth > overlap_limit(structure_, options_)) return true;
    const double open = options_.elastic ? 0 : result_.gaps.max;
    return result_.contact.touches() && std::max(open, result_.drive_gap) > options_.gap_limit;
  }

  bool is_at_rest() const {
    if (!world_.contacts_agree()) return false;
    if (!options_.elastic) return world_.parts().fastest_hinge() <= options_.settle_speed;
    const double force = largest_hinge_force(structure_, result_.state, *options_.elastic);
    const double limit = options_.settle_force * std::max(force, least_force);
    const double motion = world_.parts().fastest() * options_.step_s;
    return world_.free_force() <= limit && motion * std::max(motion, force) <= limit;
  }

  /// Returns whether the parts are at rest, and then clears the residual motion.
  bool comes_to_rest() {
    const bool rests = is_at_rest();
    if (rests) result_.residual_motion = 0;
    return rests;
  }

  /// Returns whether parts stayed within the allowed residual motion over the last steps.
  bool stays_in_place() {
    if (!options_.elastic || options_.settle_residual_motion == 0 ||
        all_steps_ - drive_steps_ < min_window_steps || result_.steps < all_steps_ - window_steps)
      return false;
    if (window_.empty()) window_ = result_.state;
    result_.residual_motion = std::max(result_.residual_motion, farthest_from(window_));
    return result_.steps == all_steps_ && result_.residual_motion <= options_.settle_residual_motion;
  }

  double farthest_from(const model::State& reference) const {
    double farthest = 0;
    for (std::size_t b = 0; b < reference.size(); ++b) {
      const model::Pose& now = result_.state[b];
      const double shift = (now.p - reference[b].p).norm() / structure_.size.edge_mm;
      const double turn = (now.R - reference[b].R).norm() / std::sqrt(2.0);
      farthest = std::max(farthest, shift + turn / 2);
    }
    return farthest;
  }

  void show() {
    if (observer_.progress && result_.steps % std::max(1, all_steps_ / 100) == 0)
      observer_.progress(static_cast<double>(result_.steps) / (all_steps_ + 1));
    if (observer_.frame && result_.steps * options_.step_s >= next_frame_s_ - 1e-9) show_frame();
  }

  void show_frame() {
    observer_.frame(result_.simulated_s, result_.state);
    last_frame_ = result_.steps;
    next_frame_s_ += observer_.frame_interval_s;
  }

  void show_end() {
    if (observer_.frame && last_frame_ != result_.steps) show_frame();
    if (observer_.progress) observer_.progress(1);
  }

  const model::Linkage& structure_;
  const model::LinkageDrive& drive_;
  const PhysicsOptions& options_;
  const PhysicsObserver& observer_;
  const double theta_;
  const int drive_steps_, all_steps_;
  const double rate_;  ///< mean rate of theta, rad/s
  const double damping_;
  const std::vector<model::Twist> start_;
  World world_;
  PhysicsResult result_;
  double energy_ = std::numeric_limits<double>::infinity();  ///< kinetic, at the last step of settling
  int steps_downhill_ = 0;                                   ///< since parts stopped
  // Largest motion of a part per step, cell edges or rad: since parts stopped, before that, and its limit.
  double motion_ = 0, previous_motion_ = std::numeric_limits<double>::infinity(),
         max_motion_ = std::numeric_limits<double>::infinity();
  model::State window_;  ///< state at the first of the last steps
  double next_frame_s_ = 0;
  int last_frame_ = -1;
};

void refuse_unknown(const model::LinkageDrive& drive, const PhysicsOptions& options) {
  if (!drive.is_external() && !options.elastic)
    throw InvalidInput("shape_memory needs elastic hinges in the simulation. Give `hinge: {model: elastic}`",
                       {"", 0, 0, "drive.kind"});
}

}  // namespace

PhysicsResult run_compression(const model::Linkage& structure, const model::LinkageDrive& drive,
                              const PhysicsOptions& options, const PhysicsObserver& observer) {
  options.validate();
  if (drive.press && !options.elastic)
    throw InvalidInput(
        "true needs elastic hinges: nothing else would press a sheet against plates that do not hold it",
        {"", 0, 0, "drive.press"});
  refuse_unknown(drive, options);
  if (observer.frame && !(observer.frame_interval_s > 0))
    throw InvalidInput(fmt::format("frame_interval_s is {}, must be positive", observer.frame_interval_s));
  return Run(structure, drive, options, observer).run();
}

std::vector<TouchingPieces> touching_pieces(const model::Linkage& structure, const ContactParts& parts) {
  return World(structure, std::nullopt, {}, &parts).touching_pieces();
}

PhysicsResult run_with_parts(const model::Linkage& structure, const model::LinkageDrive& drive,
                             const PhysicsOptions& options, const ContactParts& parts,
                             const PhysicsObserver& observer) {
  options.validate();
  if (options.elastic) throw InvalidInput("bodies collide by pieces only if hinges are revolute joints");
  refuse_unknown(drive, options);
  return Run(structure, drive, options, observer, &parts).run();
}

}  // namespace kinetix::sim
