#include "app/goals/surface/ribs_scene.hpp"

#include <fmt/format.h>

#include "app/goals/surface/ribs_outcome.hpp"
#include "app/pipeline/exact_state.hpp"
#include "app/pipeline/physics_settings.hpp"
#include "app/run/search_words.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app {
namespace {

// Measured, s of search a body, as of helmets.
constexpr double seconds_a_body_of_ribs = 3e-4;

model::State in_given(const targets::RibbedSurface& surface, model::State state) {
  for (model::Pose& pose : state) pose = {surface.to_given.linear() * pose.R, surface.to_given * pose.p};
  return state;
}

class RibsScene final : public Scene {
 public:
  explicit RibsScene(RibsFile file) : file_(std::move(file)) {}

  std::string name() const override { return file_.name; }

  Forecast forecast() const override {
    const optim::RibsLayout layout = plan_ribs(file_.surface, file_.spec);
    Forecast out{make_fishbone(layout.spine_and_ribs, file_.spec.size).structure};
    const Eigen::Vector3d size = bounds(file_.surface.surface.mesh()).sizes();
    out.folded_mm = {size.x(), size.y(), size.z()};
    out.search_s = seconds_a_body_of_ribs * out.sheet.bodies();
    add_settings(file_, out);
    return out;
  }

  void solve(Run& run, const RunOptions& options) const override {
    take_settings(run, file_);
    options.progress("search", 0);
    optim::SolverOptions search;
    follow(options, optim::ribs_residual_in_cells * file_.spec.size.edge_mm, search);
    auto ribs = std::make_unique<RibsOutcome>(file_, fit_ribs(file_.surface, file_.spec, search));
    ribs->tolerances = {{"shape", file_.shape_tolerance}, {"covered_share", file_.covered_tolerance}};
    run.design.structure = ribs->design.fishbone.structure;
    run.theta = ribs->design.shape.theta;
    run.goal = std::move(ribs);
  }

  void add_state(Run& run, const RunOptions&) const override {
    const model::State& folded = outcome_of<RibsOutcome>(run).design.state;
    run.states.push_back({"target", to_string(Model::exact), run.theta, in_given(file_.surface, folded),
                          hinge_gaps(run.design.structure, folded)});
    run.fidelity.push_back(exact_fidelity(run.plan.exact, run.design.structure, run.theta));
  }

  void judge(Run& run, const RunOptions& options) const override {
    auto& ribs = outcome_of<RibsOutcome>(run);
    judge_model(run, ribs);
    for (SurfaceWay& way : ways_by_ribs(file_.surface, file_.spec, false, options.stop))
      ribs.ways.push_back(std::move(way));
  }

  std::optional<Judged> judged(const Run& run, const model::Sheet&,
                               const model::State& state) const override {
    const model::Pose motion = motion_onto(state, own_state(run));
    const model::State placed = moved(state, motion);
    Judged out{{}, file_.shape_tolerance * file_.surface.diagonal};
    for (int body = 0; body < static_cast<int>(state.size()); ++body) {
      const targets::ClosestMeshPoint at = file_.surface.surface.closest(placed[body].p);
      out.points.push_back({{body}, state[body].p, motion.R.transpose() * at.normal, at.distance});
    }
    return out;
  }

  model::State own_state(const Run& run) const override { return outcome_of<RibsOutcome>(run).design.state; }

  std::optional<PhysicsTask> physics_task(const Run& run) const override {
    return PhysicsTask{own_state(run), drive_to(run.design.structure, run.theta),
                       physics_options(file_.physics, file_.spec.size.edge_mm)};
  }

  void judge_physics(Run& run) const override {
    auto& ribs = outcome_of<RibsOutcome>(run);
    const model::State on_surface = aligned(run.verification->physics.state, ribs.design.state);
    run.states.back().poses = in_given(file_.surface, on_surface);
    ribs.settled = measured(ribs, on_surface);
    ribs.physics_violations = violations(file_, *ribs.settled, "physics run");
  }

  void add_frames(Run& run) const override {
    const optim::RibsDesign& design = outcome_of<RibsOutcome>(run).design;
    for (int k = 0; k < motion_states; ++k) {
      const double theta = run.theta * k / (motion_states - 1);
      model::State state = placed_fishbone(design.fishbone, design.shape, theta);
      const model::HingeGaps gaps = hinge_gaps(run.design.structure, state);
      run.states.push_back(
          {"frame", to_string(Model::exact), theta, in_given(file_.surface, std::move(state)), gaps});
    }
  }

 private:
  SurfaceWay measured(const RibsOutcome& ribs, const model::State& state) const {
    const optim::RibsError error =
        optim::ribs_error(ribs.design.fishbone, state, file_.surface.surface, file_.spec.clearance_mm);
    SurfaceWay way = ribs.ways.front();
    way.rms = error.rms / file_.surface.diagonal;
    way.max = error.max / file_.surface.diagonal;
    return way;
  }

  void judge_model(const Run& run, RibsOutcome& ribs) const {
    ribs.violations = violations(file_, ribs.ways.front(), "model");
    for (const std::string& why : violations(file_, ribs.cover)) ribs.violations.push_back(why);
    for (const std::string& pair : ribs.design.collisions) ribs.violations.push_back(pair);
    const auto& range = run.plan.free_range;
    if (range && range->positive.touches && run.theta > range->positive.theta)
      ribs.violations.push_back(fmt::format(
          "walls collide on the way, at theta {:.2f} deg: use lower or thinner walls, or fewer ribs",
          to_degrees(range->positive.theta)));
  }

  RibsFile file_;
};

}  // namespace

std::unique_ptr<Scene> make_scene(RibsFile file) { return std::make_unique<RibsScene>(std::move(file)); }

}  // namespace kinetix::app
