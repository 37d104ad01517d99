#include "sim/pull_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "model/base/invalid_input.hpp"
#include "sim/joints/hand.hpp"
#include "sim/rigid_parts.hpp"
#include "sim/verdict.hpp"
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
    judge(structure_, model::LinkageDrive(), options_, settled, result_);
    result_.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    if (observer_.progress) observer_.progress(1);
    return std::move(result_);
  }

 private:
  void step() {
    const double tau = std::min(1.0, (result_.steps + 1.0) / drive_steps_);
    grasp(model::pull_at(structure_, pull_, tau * (2 - tau)));
    world_.parts().damp(damping_);
    world_.step();
    ++result_.steps;
    measure();
    if (observer_.progress && result_.steps % std::max(1, all_steps_ / 100) == 0)
      observer_.progress(static_cast<double>(result_.steps) / (all_steps_ + 1));
  }

  void grasp(const model::Pull& now) {
    const std::vector<Eigen::Vector3d> arms = model::pull_points(now.turns);
    const double stiffness = pull_stiffness / static_cast<double>(arms.size());
    std::vector<Grasp>& grasps = world_.hand().grasps;
    grasps.clear();
    for (int b = 0; b < static_cast<int>(now.to.size()); ++b)
      for (const Eigen::Vector3d& arm : arms)
        grasps.push_back({b, arm, now.to[b].p / structure_.size.edge_mm + now.to[b].R * arm, stiffness});
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
  if (options.elastic) throw InvalidInput("bodies are pulled where hinges are rotary only");
  return PullRun(structure, pull, options, parts, observer).run();
}

}  // namespace kinetix::sim
