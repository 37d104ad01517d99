#include "app/goals/ribs/ribs_goal.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "model/base/algorithms.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app {

SurfaceMethod fishbone_method(const optim::RibsDesign& design, const targets::RibbedSurface& surface) {
  return {"fishbone", design.error.rms / surface.diagonal, design.error.max / surface.diagonal, 1,
          optim::open_area(static_cast<int>(design.fishbone.structure.cells.size()),
                           design.fishbone.structure.size, design.shape.theta, surface.area)};
}

std::vector<SurfaceMethod> rib_methods(const targets::RibbedSurface& surface, const optim::RibsSpec& spec,
                                       bool with_fishbone, const std::stop_token& stop) {
  std::vector<SurfaceMethod> out;
  optim::SolverOptions search;
  search.stop = stop;
  if (stop.stop_requested()) return out;
  if (with_fishbone) out.push_back(fishbone_method(fit_ribs(surface, spec, search), surface));
  if (stop.stop_requested()) return {};
  const optim::LooseRibs loose = fit_loose_ribs(surface, spec, search);
  if (stop.stop_requested()) return {};
  out.push_back(
      {"loose ribs", loose.rms / surface.diagonal, loose.max / surface.diagonal, loose.pieces, loose.open});
  return out;
}

nlohmann::ordered_json methods_json(const std::vector<SurfaceMethod>& methods) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const SurfaceMethod& method : methods)
    out.push_back({{"way", method.name},
                   {"rms", method.rms},
                   {"max", method.max},
                   {"pieces", method.pieces},
                   {"open_area", method.open}});
  return out;
}

std::string describe(const std::vector<SurfaceMethod>& methods) {
  std::string out;
  for (const SurfaceMethod& method : methods)
    out += fmt::format("{}{}: {}, {:.3f} % of the diagonal off, {:.0f} % of the area open",
                       out.empty() ? "" : "; ", method.name,
                       targets::counted(static_cast<std::size_t>(method.pieces), "piece"), 100 * method.rms,
                       100 * method.open);
  return out;
}

namespace {

using Json = nlohmann::ordered_json;

constexpr double seconds_per_body = 3e-4;  // search time in s per body, measured

class RibsGoal final : public Goal {
 public:
  explicit RibsGoal(RibsTask task) : Goal(task.name), task_(std::move(task)) {}

  Forecast forecast() const override {
    const optim::RibsLayout layout = task_.plan();
    Forecast out{make_fishbone(layout.spine_and_ribs, task_.spec.size).structure};
    out.search_s = seconds_per_body * out.sheet.bodies();
    out.folded_mm = task_.folded_mm;
    if (task_.has_notes) out.notes = layout.notes;
    add_settings(task_.settings, out);
    return out;
  }

  SearchResult search(const RunOptions& options) const override {
    SearchResult out;
    copy_settings(out, task_.settings);
    options.progress("search", 0);
    optim::SolverOptions solver = task_.solver;
    follow(options, optim::ribs_residual_in_cells * task_.spec.size.edge_mm, solver);
    auto ribs =
        task_.outcome(fit_layout(task_.plan(), task_.over, Eigen::Vector3d::Zero(), task_.spec, solver));
    out.tolerances = task_.tolerances;
    out.design.structure = ribs->design.fishbone.structure;
    out.theta = ribs->design.shape.theta;
    out.motion = [fishbone = ribs->design.fishbone, shape = ribs->design.shape](double theta) {
      return placed_fishbone(fishbone, shape, theta);
    };
    out.to_shown = to_given();
    out.is_aligned = task_.is_aligned;
    out.bounds = task_.bounds;
    out.goal = std::move(ribs);
    return out;
  }

  std::shared_ptr<const Measure> measure(const Run& run, StateOf of, const model::State& state,
                                         const RunOptions& options) const override {
    const auto& ribs = outcome_of<RibsOutcome>(run);
    const model::State placed = of == StateOf::model ? state : aligned(state, run.own);
    auto out = std::make_shared<RibsMeasure>();
    out->error = of == StateOf::model
                     ? ribs.design.error
                     : optim::ribs_error(ribs.design.fishbone, placed, task_.over, task_.spec.clearance_mm);
    ribs.evaluate(run.design.structure, of, placed, *out);
    if (of == StateOf::physics) {
      out->shown = moved(placed, to_given());
      return out;
    }
    model::append(ribs.bare(), out->violations);
    model::append(ribs.design.collisions, out->violations);
    model::append(collisions_during_motion(run, "use lower or thinner walls, or fewer ribs"),
                  out->violations);
    model::append(ribs.other_methods(options.stop), out->methods);
    return out;
  }

  /// Observes the distance of every body from the surface plus the clearance, mm.
  std::optional<Observed> observe(const SearchResult& found, const model::Lattice&,
                                  const model::State& state) const override {
    const model::Pose motion = motion_onto(state, found.own);
    const model::State placed = moved(state, motion);
    Observed out{{}, task_.rms_mm};
    for (int body = 0; body < static_cast<int>(state.size()); ++body) {
      const targets::ClosestMeshPoint at = task_.over.closest(placed[body].p);
      out.points.push_back(
          {{body}, state[body].p, motion.R.transpose() * at.normal, at.distance - task_.spec.clearance_mm});
    }
    return out;
  }

 private:
  model::Pose to_given() const { return {task_.to_given.linear(), task_.to_given.translation()}; }

  RibsTask task_;
};

}  // namespace

RibsOutcome::RibsOutcome(const RibsTask& task, optim::RibsDesign found)
    : design(std::move(found)),
      to_given(task.to_given),
      reach(design.fishbone.structure, design.state, task.over, task.spec.clearance_mm),
      cover(cover_by(reach, task.over.mesh(), task.lowest_z)) {}

Json RibsOutcome::line(const std::vector<Eigen::Vector3d>& points) const {
  Json out = Json::array();
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector3d q = to_given * p;
    out.push_back({q.x(), q.y(), q.z()});
  }
  return out;
}

Json RibsOutcome::lines(const std::vector<std::vector<Eigen::Vector3d>>& each) const {
  Json out = Json::array();
  for (const auto& points : each) out.push_back(line(points));
  return out;
}

Json RibsOutcome::bare_lines(const std::vector<std::vector<Eigen::Vector3d>>& each) const {
  Json out = Json::array();
  for (const auto& points : each)
    for (const auto& part : uncovered_parts(reach, points)) out.push_back(line(part));
  return out;
}

Json RibsOutcome::ribs() const {
  Json out = Json::array();
  for (std::size_t r = 0; r < design.layout.spine_and_ribs.ribs.size(); ++r) {
    const model::FishboneRib& rib = design.layout.spine_and_ribs.ribs[r];
    out.push_back({{"row", rib.row}, {"cells", rib.cells}, {"rms_mm", design.error.of_ribs[r]}});
  }
  return out;
}

std::unique_ptr<Goal> make_ribs_goal(RibsTask task) { return std::make_unique<RibsGoal>(std::move(task)); }

}  // namespace kinetix::app
