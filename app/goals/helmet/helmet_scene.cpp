#include <fmt/format.h>

#include <utility>

#include "app/goals/helmet/helmet_kind.hpp"
#include "app/goals/helmet/helmet_outcome.hpp"
#include "app/pipeline/exact_state.hpp"
#include "app/pipeline/physics_settings.hpp"
#include "app/run/search_words.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app {
namespace {

using Eigen::Vector3d;

const Vector3d crown = Vector3d::Zero();  // mm, the origin of the head's frame

optim::SolverOptions search_of(const HelmetFile& file) {
  optim::SolverOptions options;
  options.max_evaluations = file.solver.max_evaluations.value_or(helmet_evaluations);
  return options;
}

model::State in_mesh(const targets::Head& head, model::State state) {
  for (model::Pose& pose : state) pose = {head.to_mesh.linear() * pose.R, head.to_mesh * pose.p};
  return state;
}

/// That walls lie in the head, and whether the clearance alone makes them.
std::string in_words(const targets::WallsInside& inside, const HelmetFile& file, const std::string& who) {
  const double reach = file.spec.size.height_mm / 2;
  std::string text = fmt::format("{}: {} wall{} in the head", who, inside.hinges.size(),
                                 inside.hinges.size() == 1 ? " lies" : "s lie");
  if (inside.depth_mm > 0) text += fmt::format(", up to {:.2g} mm deep", inside.depth_mm);
  if (file.spec.clearance_mm < reach)
    text += fmt::format(": clearance_mm is {:g}, less than half the height of the walls, {:g} mm",
                        file.spec.clearance_mm, reach);
  return text;
}

std::vector<std::string> violations(const HelmetFile& file, const optim::RibsError& error,
                                    const targets::WallsInside& inside, const std::string& who) {
  std::vector<std::string> why;
  if (!inside.hinges.empty()) why.push_back(in_words(inside, file, who));
  if (!(error.rms <= file.rms_mm))
    why.push_back(fmt::format("{}: {:.2f} mm rms from head plus clearance; at most {:g} mm is allowed", who,
                              error.rms, file.rms_mm));
  if (!(error.max <= file.max_mm))
    why.push_back(fmt::format("{}: up to {:.2f} mm from head plus clearance; at most {:g} mm is allowed", who,
                              error.max, file.max_mm));
  return why;
}

/// Reports a head that is covered less than the file requires.
std::vector<std::string> bare(const HelmetFile& file, const optim::RibsCover& cover) {
  if (!file.covered_share || cover.share >= *file.covered_share) return {};
  return {
      fmt::format("model: {:.0f} % of the head above the rim lies within a cell edge of a rib; at least "
                  "{:.0f} % is required "
                  "(`tolerance.covered_share`). Give more `target.ribs`",
                  100 * cover.share, 100 * *file.covered_share)};
}

std::vector<std::string> collisions(const Run& run) {
  const auto& range = run.plan.free_range;
  if (!range || !range->positive.touches || run.theta <= range->positive.theta) return {};
  return {
      fmt::format("walls collide on the way, at theta {:.2f} deg: use lower or thinner walls, or fewer ribs",
                  to_degrees(range->positive.theta))};
}

void append(std::vector<std::string>& to, const std::vector<std::string>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

/// Of the head down to where it is covered, and of walls around it, whose middles the clearance ends at.
Eigen::Vector3d covered_size(const HelmetFile& file) {
  Eigen::AlignedBox3d head;
  for (const Vector3d& vertex : file.head.dome.mesh().vertices)
    if (vertex.z() >= crown.z() - file.head.coverage_mm) head.extend(vertex);
  const double around = file.spec.clearance_mm + file.spec.size.height_mm / 2;
  return head.sizes() + Vector3d(2 * around, 2 * around, around);
}

constexpr double seconds_a_helmet_body = 3e-4;  // s of search, measured

class HelmetScene final : public Scene {
 public:
  explicit HelmetScene(HelmetFile file) : file_(std::move(file)) {}

  std::string name() const override { return file_.name; }

  Forecast forecast() const override {
    const optim::RibsLayout layout = plan_helmet(file_.head.dome, crown, file_.spec);
    Forecast out{make_fishbone(layout.spine_and_ribs, file_.spec.size).structure};
    out.search_s = seconds_a_helmet_body * out.sheet.bodies();
    out.folded_mm = covered_size(file_);
    out.notes = layout.notes;
    add_settings(file_, out);
    return out;
  }

  void solve(Run& run, const RunOptions& options) const override {
    take_settings(run, file_);
    options.progress("search", 0);
    auto helmet = std::make_unique<HelmetOutcome>(
        file_.head, file_.spec, fit_helmet(file_.head.dome, crown, file_.spec, followed(options)));
    helmet->tolerances = {{"rms_mm", file_.rms_mm}, {"max_mm", file_.max_mm}};
    if (file_.covered_share) helmet->tolerances.emplace_back("covered_share", *file_.covered_share);
    run.design.structure = helmet->design.fishbone.structure;
    run.theta = helmet->design.shape.theta;
    run.goal = std::move(helmet);
  }

  void add_state(Run& run, const RunOptions&) const override {
    const model::State& folded = outcome_of<HelmetOutcome>(run).design.state;
    run.states.push_back({"target", to_string(Model::exact), run.theta, in_mesh(file_.head, folded),
                          hinge_gaps(run.design.structure, folded)});
    run.fidelity.push_back(exact_fidelity(run.plan.exact, run.design.structure, run.theta));
  }

  void judge(Run& run, const RunOptions&) const override {
    auto& helmet = outcome_of<HelmetOutcome>(run);
    helmet.inside = walls_inside(run.design.structure, helmet.design.state, file_.head.scan);
    helmet.violations = violations(file_, helmet.design.error, helmet.inside, "model");
    append(helmet.violations, bare(file_, helmet.cover));
    append(helmet.violations, helmet.design.collisions);
    append(helmet.violations, collisions(run));
  }

  /// Every body, from head plus clearance.
  std::optional<Judged> judged(const Run& run, const model::Sheet&,
                               const model::State& state) const override {
    const model::Pose motion = motion_onto(state, own_state(run));
    const model::State on_head = moved(state, motion);
    Judged out{{}, file_.rms_mm};
    for (int body = 0; body < static_cast<int>(state.size()); ++body) {
      const targets::ClosestMeshPoint at = file_.head.dome.closest(on_head[body].p);
      out.points.push_back(
          {{body}, state[body].p, motion.R.transpose() * at.normal, at.distance - file_.spec.clearance_mm});
    }
    return out;
  }

  TurnBounds turn_bounds() const override { return {file_.spec.tilt, file_.spec.theta}; }

  /// On the head.
  model::State shown(const Run& run, const model::State& state) const override {
    return in_mesh(file_.head, aligned(state, own_state(run)));
  }

  model::State own_state(const Run& run) const override {
    return outcome_of<HelmetOutcome>(run).design.state;
  }

  std::optional<PhysicsTask> physics_task(const Run& run) const override {
    return PhysicsTask{outcome_of<HelmetOutcome>(run).design.state, drive_to(run.design.structure, run.theta),
                       rotary_physics(file_.hinge, file_.physics, file_.spec.size.edge_mm)};
  }

  void judge_physics(Run& run) const override {
    auto& helmet = outcome_of<HelmetOutcome>(run);
    const model::State on_head = aligned(run.verification->physics.state, helmet.design.state);
    run.states.back().poses = in_mesh(file_.head, on_head);
    helmet.physics =
        optim::ribs_error(helmet.design.fishbone, on_head, file_.head.dome, file_.spec.clearance_mm);
    helmet.physics_inside = walls_inside(run.design.structure, on_head, file_.head.scan);
    helmet.physics_violations = violations(file_, *helmet.physics, helmet.physics_inside, "physics run");
  }

  /// How elastic hinges keep the goal.
  void judge_matter(Run& run, const model::State& state) const override {
    auto& helmet = outcome_of<HelmetOutcome>(run);
    const model::State on_head = aligned(state, helmet.design.state);
    helmet.design.error =
        optim::ribs_error(helmet.design.fishbone, on_head, file_.head.dome, file_.spec.clearance_mm);
    helmet.inside = walls_inside(run.design.structure, on_head, file_.head.scan);
    helmet.violations = violations(file_, helmet.design.error, helmet.inside, "equilibrium");
    append(helmet.violations, bare(file_, helmet.cover));
    append(helmet.violations, helmet.design.collisions);
    append(helmet.violations, collisions(run));
  }

  void add_frames(Run& run) const override {
    const optim::RibsDesign& design = outcome_of<HelmetOutcome>(run).design;
    for (int k = 0; k < motion_states; ++k) {
      const double theta = run.theta * k / (motion_states - 1);
      model::State state = placed_fishbone(design.fishbone, design.shape, theta);
      const model::HingeGaps gaps = hinge_gaps(run.design.structure, state);
      run.states.push_back(
          {"frame", to_string(Model::exact), theta, in_mesh(file_.head, std::move(state)), gaps});
    }
  }

 private:
  optim::SolverOptions followed(const RunOptions& options) const {
    optim::SolverOptions search = search_of(file_);
    follow(options, optim::ribs_residual_in_cells * file_.spec.size.edge_mm, search);
    return search;
  }

  HelmetFile file_;
};

}  // namespace

std::unique_ptr<Scene> make_scene(HelmetFile file) { return std::make_unique<HelmetScene>(std::move(file)); }

// The kind for the registry (app/goals/registry.cpp), and its metrics with their units.
const GoalKind helmet_kind = {
    .name = "helmet",
    .example = "target: {kind: helmet, mesh: head.obj}",
    .read = [](const targets::Node& root) { return make_scene(read_helmet_file(root)); },
    .table = helmet_keys,
    .metrics = {
        {"distance_rms_mm", "mm",
         "[distance from head plus clearance](#distances-of-a-helmet), root mean square"},
        {"distance_max_mm", "mm", "likewise, the largest"},
        {"rib_rms_mm", "mm", "distance of the worst rib's midline from its section curve"},
        {"covered_share", "",
         "[share of the head's area above the rim within a cell edge of a rib](#covered_share)"},
        {"goal_rms_mm", "mm", "distance of the head, plus clearance, from the nearest rib, root mean square"},
        {"goal_max_mm", "mm", "likewise, the largest"},
        {"walls_inside", "", "how many walls lie in the head"},
        {"walls_inside_physics", "", "walls_inside in the physics run"},
        {"distance_rms_mm_physics", "mm", "distance_rms_mm in the physics run"},
        {"distance_max_mm_physics", "mm", "distance_max_mm in the physics run"}}};

}  // namespace kinetix::app
