#include <fmt/format.h>

#include <utility>

#include "app/goals/helmet/helmet_kind.hpp"
#include "app/goals/helmet/helmet_outcome.hpp"
#include "app/run/contact_reason.hpp"
#include "app/run/fishbone_motion.hpp"
#include "app/run/search_words.hpp"
#include "model/base/append.hpp"
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

/// Of the head down to where it is covered, and of walls around it, whose middles the clearance ends at.
Eigen::Vector3d covered_size(const HelmetFile& file) {
  Eigen::AlignedBox3d head;
  for (const Vector3d& vertex : file.head.dome.mesh().vertices)
    if (vertex.z() >= crown.z() - file.head.coverage_mm) head.extend(vertex);
  const double around = file.spec.clearance_mm + file.spec.size.height_mm / 2;
  return head.sizes() + Vector3d(2 * around, 2 * around, around);
}

constexpr double seconds_a_helmet_body = 3e-4;  // s of search, measured

class HelmetGoal final : public Goal {
 public:
  explicit HelmetGoal(HelmetFile file) : Goal(file.name), file_(std::move(file)) {}

  Forecast forecast() const override {
    const optim::RibsLayout layout = plan_helmet(file_.head.dome, crown, file_.spec);
    Forecast out{make_fishbone(layout.spine_and_ribs, file_.spec.size).structure};
    out.search_s = seconds_a_helmet_body * out.sheet.bodies();
    out.folded_mm = covered_size(file_);
    out.notes = layout.notes;
    add_settings(file_, out);
    return out;
  }

  Found search(const RunOptions& options) const override {
    Found out;
    take_settings(out, file_);
    options.progress("search", 0);
    auto helmet = std::make_unique<HelmetOutcome>(
        file_.head, file_.spec, fit_helmet(file_.head.dome, crown, file_.spec, followed(options)));
    out.tolerances = {{"rms_mm", file_.rms_mm}, {"max_mm", file_.max_mm}};
    if (file_.covered_share) out.tolerances.emplace_back("covered_share", *file_.covered_share);
    out.design.structure = helmet->design.fishbone.structure;
    out.theta = helmet->design.shape.theta;
    out.motion = motion_of(helmet->design);
    out.to_shown = pose_of(file_.head.to_mesh);
    out.is_laid_over = true;
    out.bounds = {file_.spec.tilt, file_.spec.theta};
    out.goal = std::move(helmet);
    return out;
  }

  std::shared_ptr<const Measure> measure(const Run& run, StateOf of, const model::State& state,
                                         const RunOptions&) const override {
    const auto& helmet = outcome_of<HelmetOutcome>(run);
    const model::State on_head = of == StateOf::model ? state : aligned(state, run.own);
    auto out = std::make_shared<HelmetMeasure>();
    out->error = of == StateOf::model ? helmet.design.error
                                      : optim::ribs_error(helmet.design.fishbone, on_head, file_.head.dome,
                                                          file_.spec.clearance_mm);
    out->inside = walls_inside(run.design.structure, on_head, file_.head.scan);
    if (!helmet.head.openings.empty()) out->warnings = {invented(helmet.head.openings)};
    out->violations = violations(file_, out->error, out->inside, in_words(of));
    if (of == StateOf::physics) {
      out->shown = moved(on_head, pose_of(file_.head.to_mesh));
      return out;
    }
    model::append(bare(file_, helmet.cover), out->violations);
    model::append(helmet.design.collisions, out->violations);
    model::append(collisions_on_the_way(run, "use lower or thinner walls, or fewer ribs"), out->violations);
    return out;
  }

  /// Every body, from head plus clearance.
  std::optional<Observed> observe(const Found& found, const model::Sheet&,
                                  const model::State& state) const override {
    const model::Pose motion = motion_onto(state, found.own);
    const model::State on_head = moved(state, motion);
    Observed out{{}, file_.rms_mm};
    for (int body = 0; body < static_cast<int>(state.size()); ++body) {
      const targets::ClosestMeshPoint at = file_.head.dome.closest(on_head[body].p);
      out.points.push_back(
          {{body}, state[body].p, motion.R.transpose() * at.normal, at.distance - file_.spec.clearance_mm});
    }
    return out;
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

std::unique_ptr<Goal> make_goal(HelmetFile file) { return std::make_unique<HelmetGoal>(std::move(file)); }

// The kind for the registry (app/goals/registry.cpp), and its metrics with their units.
const GoalKind helmet_kind = {
    .name = "helmet",
    .example = "target: {kind: helmet, mesh: head.obj}",
    .read = [](const targets::Node& root) { return make_goal(read_helmet_file(root)); },
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
