#include <Eigen/Geometry>

#include "app/goals/outline/outline_kind.hpp"
#include "app/goals/outline/outline_outcome.hpp"
#include "app/pipeline/exact_state.hpp"
#include "model/base/invalid_input.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app {
namespace {

model::Pose turned_about_z(double angle) {
  return {Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix(), Eigen::Vector3d::Zero()};
}

/// Of a state anywhere in space, laid over the exact one.
targets::OutlineError error_of(const OutlineOutcome& outline, const model::State& state, double edge_mm) {
  const model::State placed = aligned(state, outline.exact);
  std::vector<Eigen::Vector2d> rim;
  for (const int body : outline.rim) rim.push_back(placed[body].p.head<2>());
  return outline_error(targets::Outline(outline.placed(edge_mm)), rim);
}

/// Families lay a sheet down each in their own place, and the search has the outline as it lies on the lattice: the outline
/// goes where the first body of the state is that results show. @param edge_mm cell edge of the sheet, mm
void move_outline(const model::State& shown, double edge_mm, double turn, optim::OutlineDesign& design) {
  const model::PlanarStructure& panel = design.panel;
  const model::Pose searched =
      model::redrawn_pose(panel.graph.vertices[0], design.y[0], panel.senses[0], design.theta);
  const Eigen::Vector2d from_first = design.origin - searched.p.head<2>();
  design.origin = shown[0].p.head<2>() / edge_mm + Eigen::Rotation2Dd(-turn) * from_first;
}

/// @param who the state is of that results show
std::vector<std::string> all_violations(const OutlineFile& file, const OutlineOutcome& outline,
                                        const std::string& who) {
  std::vector<std::string> why = violations(file, outline.error(), who);
  if (file.flat)
    for (const std::string& lacks : violations(file, outline.design.flat, "flat")) why.push_back(lacks);
  if (!outline.design.clear)
    why.push_back(
        outline.design.stopped
            ? "walls meet before the panel is pressed so far, where the search was stopped"
            : "walls meet before the panel is pressed so far: use thinner walls or a smaller theta");
  return why;
}

// Measured, s: where the folded outline alone is asked for, and where the flat one is, too.
constexpr double seconds_a_wall = 0.005, seconds_a_wall_of_both = 0.02;

class OutlineScene final : public Scene {
 public:
  explicit OutlineScene(OutlineFile file) : file_(std::move(file)) {}

  std::string name() const override { return file_.name; }

  Forecast forecast() const override {
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d& point : file_.folded.points()) box.extend(point);
    const OutlineStart start = outline_start(file_);
    Forecast out{make_sheet(file_.lattice, start.cells, file_.size(start.edge_mm))};
    if (!file_.cell_mm) out.folded_mm = {box.sizes().x(), box.sizes().y(), out.sheet.size().height_mm};
    out.search_s = out.sheet.hinges() * (file_.flat ? seconds_a_wall_of_both : seconds_a_wall);
    add_settings(file_, out);
    return out;
  }

  void solve(Run& run, const RunOptions& options) const override {
    take_settings(run, file_);
    auto outline = std::make_unique<OutlineOutcome>(file_);
    outline->tolerances = {{"shape", file_.shape_tolerance}, {"iou", file_.iou_tolerance}};
    FoundOutline found = search_outline(file_, options);
    outline->design = std::move(found.design);
    outline->cuts = found.cuts;
    outline->turn = found.turn;
    outline->rim = outer_rim(outline->design.panel.graph).vertices;
    outline->violations = all_violations(file_, *outline, "model");
    run.design.structure = std::move(found.sheet);
    run.theta = outline->design.theta;
    run.goal = std::move(outline);
  }

  void add_state(Run& run, const RunOptions&) const override {
    if (!run.plan.exact)
      throw InvalidInput("no panel with such offsets moves exactly: " + run.plan.exact.why,
                         {"", 0, 0, "variables.offset_mm"});
    add_exact_state(run, run.theta);
    auto& outline = outcome_of<OutlineOutcome>(run);
    turn_back(run, 0);
    outline.exact = run.states.front().poses;
    move_outline(outline.exact, run.design.structure.size().edge_mm, outline.turn, outline.design);
  }

  /// As it lies on the lattice, along which its drive goes.
  model::State own_state(const Run& run) const override {
    const auto& outline = outcome_of<OutlineOutcome>(run);
    return moved(outline.exact, turned_about_z(outline.turn));
  }

  /// In the place of the exact state.
  model::State shown(const Run& run, const model::State& state) const override {
    return aligned(state, outcome_of<OutlineOutcome>(run).exact);
  }

  /// Each vertex of the rim.
  std::optional<Judged> judged(const Run& run, const model::Sheet&,
                               const model::State& state) const override {
    const auto& outline = outcome_of<OutlineOutcome>(run);
    const targets::Outline goal(outline.placed(run.design.structure.size().edge_mm));
    const model::Pose motion = motion_onto(state, outline.exact);
    const model::State placed = moved(state, motion);
    Judged out{{}, file_.shape_tolerance * goal.diagonal()};
    for (const int body : outline.rim) {
      const Eigen::Vector3d& place = placed[body].p;
      const targets::Outline::Nearest at = goal.nearest(place.head<2>());
      const Eigen::Vector3d normal(at.normal.x(), at.normal.y(), 0);
      out.points.push_back(
          {{body}, state[body].p, motion.R.transpose() * normal, at.normal.dot(place.head<2>() - at.point)});
    }
    return out;
  }

  TurnBounds turn_bounds() const override { return {.theta = {file_.theta[0], file_.theta[1]}}; }

  /// How elastic hinges keep the goal.
  void judge_matter(Run& run, const model::State& state) const override {
    auto& outline = outcome_of<OutlineOutcome>(run);
    outline.matter = error_of(outline, state, run.design.structure.size().edge_mm);
    outline.violations = all_violations(file_, outline, "equilibrium");
  }

  std::optional<PhysicsTask> physics_task(const Run& run) const override {
    PhysicsTask task = folding_task(run);
    task.reference = own_state(run);
    return task;
  }

  void judge_physics(Run& run) const override {
    auto& outline = outcome_of<OutlineOutcome>(run);
    outline.physics = error_of(outline, run.verification->physics.state, run.design.structure.size().edge_mm);
    outline.physics_violations = violations(file_, *outline.physics, "physics run");
  }

  void add_frames(Run& run) const override {
    const std::size_t first = run.states.size();
    add_exact_frames(run);
    turn_back(run, first);
  }

 private:
  /// States from this one on: as the outline was drawn.
  static void turn_back(Run& run, std::size_t first) {
    const double turn = outcome_of<OutlineOutcome>(run).turn;
    for (std::size_t k = first; turn != 0 && k < run.states.size(); ++k)
      run.states[k].poses = moved(std::move(run.states[k].poses), turned_about_z(-turn));
  }

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
