#include <fmt/format.h>

#include "app/goals/space_block/space_block_kind.hpp"
#include "app/goals/space_block/space_block_outcome.hpp"
#include "app/pipeline/exact_state.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app {
namespace {

/// What of the file to change for lengths at rest nearer to those asked for.
std::string size_advice(const optim::SpaceBlockVariables& given) {
  if (!given.cells) return "give smaller cells";
  return given.edge_mm ? "give other `cells` or another `cell_mm`" : "give other `cells`";
}

class SpaceBlockScene final : public Scene {
 public:
  explicit SpaceBlockScene(SpaceBlockFile file) : file_(std::move(file)) {}

  std::string name() const override { return file_.name; }

  Forecast forecast() const override {
    Forecast out{block()};
    if (const auto motion = exact_motion(out.sheet))
      out.folded_mm = size_of(out.sheet, motion.at(file_.found.theta));
    add_settings(file_, out);
    return out;
  }

  void solve(Run& run, const RunOptions&) const override {
    take_settings(run, file_);
    auto outcome = std::make_unique<SpaceBlockOutcome>(file_);
    outcome->tolerances = {{"factor", file_.factor_tolerance}};
    if (file_.goal.size_mm) outcome->tolerances.emplace_back("size", file_.size_tolerance);
    run.design.structure = block();
    run.theta = file_.found.theta;
    run.goal = std::move(outcome);
  }

  void add_state(Run& run, const RunOptions&) const override {
    add_exact_state(run, run.theta);
    outcome_of<SpaceBlockOutcome>(run).exact = run.states.front().poses;
  }

  void judge(Run& run, const RunOptions&) const override {
    auto& outcome = outcome_of<SpaceBlockOutcome>(run);
    outcome.error = error_of(run, outcome.exact);
    outcome.violations = violations(file_, outcome.error, "model");
    if (file_.goal.size_mm && !(file_.found.size_off <= file_.size_tolerance))
      outcome.violations.push_back(
          fmt::format("lengths at rest are up to {:.1f} % off those asked for; at most {:g} % is allowed: {}",
                      100 * file_.found.size_off, 100 * file_.size_tolerance, size_advice(file_.variables)));
    const auto& range = run.plan.free_range;
    if (range && range->positive.touches && run.theta > range->positive.theta)
      outcome.violations.push_back(fmt::format(
          "walls collide on the way, at theta {:.2f} deg: use lower or thinner walls, or longer gussets",
          to_degrees(range->positive.theta)));
  }

  /// Outermost rotors against the sides of the exact state.
  std::optional<Judged> judged(const Run& run, const model::Sheet&,
                               const model::State& state) const override {
    const auto& outcome = outcome_of<SpaceBlockOutcome>(run);
    const model::Pose motion = motion_onto(state, outcome.exact);
    const model::State placed = moved(state, motion);
    const auto rotors = optim::side_rotors(*run.design.structure.sodalite());
    Judged out{{}, file_.factor_tolerance * file_.found.size_mm.minCoeff()};
    for (int d = 0; d < 3; ++d)
      for (const std::vector<int>& side : rotors[d])
        for (const int r : side)
          out.points.push_back({{r},
                                state[r].p,
                                motion.R.transpose() * Eigen::Vector3d::Unit(d),
                                placed[r].p[d] - outcome.exact[r].p[d]});
    return out;
  }

  std::optional<PhysicsTask> physics_task(const Run& run) const override { return folding_task(run); }

  void judge_physics(Run& run) const override {
    auto& outcome = outcome_of<SpaceBlockOutcome>(run);
    outcome.physics = error_of(run, aligned(run.verification->physics.state, outcome.exact));
    outcome.physics_violations = violations(file_, *outcome.physics, "physics run");
  }

  void add_frames(Run& run) const override { add_exact_frames(run); }

 private:
  model::Sheet block() const { return block_of(file_.found, file_.size()); }

  /// @param state with its sides along the axes
  targets::SpaceBlockError error_of(const Run& run, const model::State& state) const {
    const model::SodaliteStructure& block = *run.design.structure.sodalite();
    const auto lengths = [&](const model::State& of) {
      return targets::block_lengths(optim::block_sides(block, of));
    };
    return space_block_error(file_.goal, lengths(rest_state(model::Linkage(run.design.structure))),
                             lengths(state));
  }

  SpaceBlockFile file_;
};

}  // namespace

std::unique_ptr<Scene> make_scene(SpaceBlockFile file) {
  return std::make_unique<SpaceBlockScene>(std::move(file));
}

// The kind for the registry (app/goals/registry.cpp), and its metrics with their units.
const GoalKind space_block_kind = {
    .name = "space_block",
    .example = "target: {kind: space_block, factor: 0.85}",
    .read = [](const targets::Node& root) { return make_scene(read_space_block_file(root)); },
    .table = space_block_keys,
    .metrics = {{"factor_off", "",
                 "largest difference of a direction's length, over that at rest, from the factor asked for"},
                {"factor_off_physics", "", "the same in the physics run"},
                {"size_off", "",
                 "largest difference of a length at rest from the one asked for, over it; where "
                 "`target.size_mm` is given"}}};

}  // namespace kinetix::app
