#include <fmt/format.h>

#include <utility>

#include "app/goals/curve/curve_kind.hpp"
#include "app/goals/curve/curve_outcome.hpp"
#include "app/pipeline/exact_state.hpp"
#include "app/pipeline/physics_settings.hpp"
#include "app/run/midline.hpp"
#include "model/sheet/sheet_motion.hpp"
#include "targets/curve/polyline_tree.hpp"

namespace kinetix::app {
namespace {

optim::CurveVariables variables_of(const CurveFile& file) {
  optim::CurveVariables v;
  v.columns = file.columns;
  v.rows = file.rows;
  v.cell_mm = file.size.edge_mm;
  v.beta = file.beta;
  v.theta = file.theta;
  v.per = file.per;
  v.symmetry = file.symmetry;
  return v;
}

optim::MultiStartOptions search_of(const CurveFile& file, const RunOptions& options) {
  optim::MultiStartOptions search;
  search.threads = options.threads;
  search.seed = options.seed;
  search.starts = file.solver.starts.value_or(search.starts);
  search.solver.name = file.solver.name.value_or(search.solver.name);
  search.solver.max_evaluations = file.solver.max_evaluations.value_or(search.solver.max_evaluations);
  return search;
}

std::vector<std::string> violations(const optim::FreeCurveDesign& found, double tolerance) {
  std::vector<std::string> why;
  const double rms = found.design.error.rms;
  if (!(rms <= tolerance)) {
    why = found.design.reach.obstacles;
    if (why.empty())
      why.push_back(fmt::format(
          "no start came closer than {:.3g} of the diagonal, although every column by itself can bend "
          "enough: use more or smaller cells",
          rms));
  }
  if (!found.walls_are_free)
    why.push_back(found.notes.back() + ": use lower or thinner walls, or larger cells");
  return why;
}

class CurveScene final : public Scene {
 public:
  explicit CurveScene(CurveFile file) : file_(std::move(file)) {}

  const targets::Curve& curve() const { return file_.curve; }
  std::string name() const override { return file_.name; }

  void solve(Run& run, const RunOptions& options) const override {
    run.physics = file_.physics;
    run.process = file_.process;
    run.verify_tolerance = file_.verify_tolerance;
    const optim::MultiStartOptions search = search_of(file_, options);
    if (options.progress) options.progress("search", 0);
    auto curve = std::make_unique<CurveOutcome>();
    curve->tolerances = {{"shape", file_.shape_tolerance}};
    curve->shape_tolerance = file_.shape_tolerance;
    curve->target_mm = file_.curve.points();
    curve->solver = search.solver;
    curve->found = fit_free_curve(file_.curve, variables_of(file_), file_.size, search);
    curve->violations = violations(curve->found, file_.shape_tolerance);
    run.structure = sheet_of(curve->found.design.design, file_.size);
    run.theta = curve->found.design.design.theta;
    run.goal = std::move(curve);
  }

  void add_state(Run& run, const RunOptions&) const override {
    const std::vector<std::string>& notes = outcome_of<CurveOutcome>(run).found.notes;
    run.plan.why.insert(run.plan.why.end(), notes.begin(), notes.end());
    add_exact_state(run, run.theta);
  }

  /// Each column's place against the goal as it was laid over the midline.
  std::optional<Judged> judged_points(const Run& run) const override {
    const targets::CurveError& error = outcome_of<CurveOutcome>(run).found.design.error;
    const targets::PolylineTree goal(error.goal_mm);
    const model::State& state = run.states.front().poses;
    const std::vector<Eigen::Vector2d> midline = column_midline(run.structure, state);
    const std::vector<std::vector<int>> columns = body_columns(run.structure);
    Judged out{drive_to(run.structure, run.theta), {}, file_.shape_tolerance * error.scale_mm};
    for (std::size_t k = 0; k < midline.size(); ++k) {
      const targets::ClosestPoint at = goal.nearest(midline[k]);
      out.points.push_back({columns[k],
                            {midline[k].x(), state[columns[k][0]].p.y(), midline[k].y()},
                            {at.normal.x(), 0, at.normal.y()},
                            at.distance});
    }
    return out;
  }

  std::optional<PhysicsTask> physics_task(const Run& run) const override {
    return PhysicsTask{run.states.front().poses, drive_to(run.structure, run.theta),
                       physics_options(file_.physics, file_.size.edge_mm)};
  }

  void add_frames(Run& run) const override { add_exact_frames(run); }

 private:
  CurveFile file_;
};

template <double targets::CurveError::*part>
double measured(const Scene& goal, const model::Sheet& structure, const model::State& state) {
  return curve_error(column_midline(structure, state), dynamic_cast<const CurveScene&>(goal).curve()).*part;
}

}  // namespace

std::unique_ptr<Scene> make_scene(CurveFile file) { return std::make_unique<CurveScene>(std::move(file)); }

// The kind for the registry (app/goals/registry.cpp), and its metrics with their units.
const GoalKind curve_kind = {
    .name = "curve",
    .example = "target: {kind: curve, points: points.csv}",
    .read = [](const targets::Node& root) { return make_scene(read_curve_file(root)); },
    .table = curve_keys,
    .metrics = {{"shape_rms", "",
                 "[distance of midline and goal](#shape_rms-and-shape_max), root mean square"},
                {"shape_max", "", "likewise, the largest"}},
    .measures = {{"shape_rms", measured<&targets::CurveError::rms>},
                 {"shape_max", measured<&targets::CurveError::max>}}};

}  // namespace kinetix::app
