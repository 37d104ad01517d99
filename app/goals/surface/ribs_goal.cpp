#include "app/goals/surface/ribs_goal.hpp"

#include <fmt/format.h>

#include "app/goals/surface/ribs_outcome.hpp"
#include "app/run/contact_reason.hpp"
#include "app/run/fishbone_motion.hpp"
#include "app/run/search_words.hpp"
#include "model/base/append.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app {
namespace {

// Measured, s of search a body, as of helmets.
constexpr double seconds_a_body_of_ribs = 3e-4;

class RibsGoal final : public Goal {
 public:
  explicit RibsGoal(RibsFile file) : Goal(file.name), file_(std::move(file)) {}

  Forecast forecast() const override {
    const optim::RibsLayout layout = plan_ribs(file_.surface, file_.spec);
    Forecast out{make_fishbone(layout.spine_and_ribs, file_.spec.size).structure};
    const Eigen::Vector3d size = bounds(file_.surface.surface.mesh()).sizes();
    out.folded_mm = {size.x(), size.y(), size.z()};
    out.search_s = seconds_a_body_of_ribs * out.sheet.bodies();
    add_settings(file_, out);
    return out;
  }

  Found search(const RunOptions& options) const override {
    Found out;
    take_settings(out, file_);
    options.progress("search", 0);
    optim::SolverOptions search;
    follow(options, optim::ribs_residual_in_cells * file_.spec.size.edge_mm, search);
    auto ribs = std::make_unique<RibsOutcome>(file_, fit_ribs(file_.surface, file_.spec, search));
    out.tolerances = {{"shape", file_.shape_tolerance}, {"covered_share", file_.covered_tolerance}};
    out.design.structure = ribs->design.fishbone.structure;
    out.theta = ribs->design.shape.theta;
    out.motion = motion_of(ribs->design);
    out.to_shown = pose_of(file_.surface.to_given);
    out.goal = std::move(ribs);
    return out;
  }

  std::shared_ptr<const Measure> measure(const Run& run, StateOf of, const model::State& state,
                                         const RunOptions& options) const override {
    if (of == StateOf::equilibrium) return nullptr;
    const auto& ribs = outcome_of<RibsOutcome>(run);
    auto out = std::make_shared<RibsMeasure>();
    out->ways = {fishbone_way(ribs.design, file_.surface)};
    if (of == StateOf::physics) {
      const model::State on_surface = aligned(state, run.own);
      const optim::RibsError error =
          optim::ribs_error(ribs.design.fishbone, on_surface, file_.surface.surface, file_.spec.clearance_mm);
      out->ways.front().rms = error.rms / file_.surface.diagonal;
      out->ways.front().max = error.max / file_.surface.diagonal;
      out->shown = moved(on_surface, pose_of(file_.surface.to_given));
      out->violations = violations(file_, out->ways.front(), in_words(of));
      return out;
    }
    out->violations = violations(file_, out->ways.front(), in_words(of));
    for (const std::string& why : violations(file_, ribs.cover)) out->violations.push_back(why);
    for (const std::string& pair : ribs.design.collisions) out->violations.push_back(pair);
    model::append(collisions_on_the_way(run, "use lower or thinner walls, or fewer ribs"), out->violations);
    for (SurfaceWay& way : ways_by_ribs(file_.surface, file_.spec, false, options.stop))
      out->ways.push_back(std::move(way));
    return out;
  }

  std::optional<Observed> observe(const Found& found, const model::Sheet&,
                                  const model::State& state) const override {
    const model::Pose motion = motion_onto(state, found.own);
    const model::State placed = moved(state, motion);
    Observed out{{}, file_.shape_tolerance * file_.surface.diagonal};
    for (int body = 0; body < static_cast<int>(state.size()); ++body) {
      const targets::ClosestMeshPoint at = file_.surface.surface.closest(placed[body].p);
      out.points.push_back({{body}, state[body].p, motion.R.transpose() * at.normal, at.distance});
    }
    return out;
  }

 private:
  RibsFile file_;
};

}  // namespace

std::unique_ptr<Goal> make_goal(RibsFile file) { return std::make_unique<RibsGoal>(std::move(file)); }

}  // namespace kinetix::app
