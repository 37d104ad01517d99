#include "app/goals/outline/outline_kind.hpp"
#include "app/goals/outline/outline_outcome.hpp"
#include "app/pipeline/exact_state.hpp"
#include "app/pipeline/physics_settings.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app {
namespace {

class OutlineScene final : public Scene {
 public:
  explicit OutlineScene(OutlineFile file) : file_(std::move(file)) {}

  std::string name() const override { return file_.name; }

  void solve(Run& run, const RunOptions& options) const override {
    run.physics = file_.physics;
    run.process = file_.process;
    run.verify_tolerance = file_.verify_tolerance;
    auto outline = std::make_unique<OutlineOutcome>(file_);
    outline->tolerances = {{"shape", file_.shape_tolerance}, {"iou", file_.iou_tolerance}};
    FoundOutline found = search_outline(file_, options);
    outline->design = std::move(found.design);
    outline->cuts = found.cuts;
    outline->rim = outer_rim(outline->design.panel.graph).vertices;
    outline->violations = violations(file_, outline->design.error, "model");
    if (file_.flat)
      for (const std::string& why : violations(file_, outline->design.flat, "flat"))
        outline->violations.push_back(why);
    if (!outline->design.clear)
      outline->violations.push_back(
          "walls meet before the panel is pressed so far: use thinner walls or a smaller theta");
    run.structure = std::move(found.sheet);
    run.theta = outline->design.theta;
    run.goal = std::move(outline);
  }

  void add_state(Run& run, const RunOptions&) const override { add_exact_state(run, run.theta); }

  /// Each vertex of the rim.
  std::optional<Judged> judged(const Run& run, const model::Sheet&, double,
                               const model::State& state) const override {
    const auto& outline = outcome_of<OutlineOutcome>(run);
    const targets::Outline goal(outline.placed(run.structure.size().edge_mm));
    const model::Pose motion = motion_onto(state, run.plan.exact.at(run.theta));
    const model::State placed = moved(state, motion);
    Judged out{{}, file_.shape_tolerance * goal.diagonal()};
    for (const int body : outline.rim) {
      const Eigen::Vector3d& place = placed[body].p;
      const targets::Outline::Nearest at = goal.nearest(place.head<2>());
      const Eigen::Vector3d normal(at.normal.x(), at.normal.y(), 0);
      out.points.push_back({{body}, state[body].p, motion.R.transpose() * normal, at.normal.dot(place.head<2>() - at.point)});
    }
    return out;
  }

  std::optional<PhysicsTask> physics_task(const Run& run) const override {
    return PhysicsTask{run.states.front().poses, drive_to(run.structure, run.theta),
                       physics_options(file_.physics, run.structure.size().edge_mm)};
  }

  /// In the place of the model's state: the run's own frame floats.
  void judge_physics(Run& run) const override {
    auto& outline = outcome_of<OutlineOutcome>(run);
    const double edge = run.structure.size().edge_mm;
    const model::State placed = aligned(run.verification->physics.state, run.states.front().poses);
    std::vector<Eigen::Vector2d> rim;
    for (const int body : outline.rim) rim.push_back(placed[body].p.head<2>());
    outline.physics = outline_error(targets::Outline(outline.placed(edge)), rim);
    outline.physics_violations = violations(file_, *outline.physics, "physics run");
  }

  void add_frames(Run& run) const override { add_exact_frames(run); }

 private:
  OutlineFile file_;
};

}  // namespace

std::unique_ptr<Scene> make_scene(OutlineFile file) {
  return std::make_unique<OutlineScene>(std::move(file));
}

// The kind for the registry (app/goals/registry.cpp), and its metrics with their units.
const GoalKind outline_kind = {
    .name = "outline",
    .example = "target: {kind: outline, points: outline.csv}",
    .read = [](const targets::Node& root) { return make_scene(read_outline_file(root)); },
    .table = outline_keys,
    .metrics = {
        {"outline_rms", "", "[vertices of the rim from the outline](#outline_rms-and-iou), root mean square"},
        {"outline_max", "", "likewise, the largest"},
        {"iou", "", "[area that panel and outline share](#outline_rms-and-iou), over that of both"},
        {"flat_rms", "", "outline_rms of the flat panel, where its outline is prescribed"},
        {"flat_iou", "", "iou of the flat panel, likewise"},
        {"outline_rms_physics", "", "outline_rms in the physics run"},
        {"iou_physics", "", "iou in the physics run"}}};

}  // namespace kinetix::app
