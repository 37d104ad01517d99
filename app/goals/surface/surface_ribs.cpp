#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/console/short_form.hpp"
#include "app/goals/ribs/ribs_goal.hpp"
#include "app/goals/surface/surface_file.hpp"
#include "app/result/result_json.hpp"
#include "targets/mesh/mesh_section.hpp"

namespace kinetix::app {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

constexpr int lines_of_surface = 11;  // sections across the spine: enough to show the shape
constexpr int points_per_rib = 60;    // points per drawn line: it looks smooth on a page

/// Returns sections of the surface across the spine and along it, in the frame of the ribs.
std::vector<std::vector<Vector3d>> lines_of(const targets::RibbedSurface& surface) {
  const targets::TriangleMesh mesh = joined(surface.surface.mesh());
  const Eigen::AlignedBox3d box = bounds(mesh);
  std::vector<std::vector<Vector3d>> out;
  const auto add = [&](const targets::Plane& plane) {
    for (const targets::SectionChain& chain : section(mesh, plane)) {
      std::vector<Vector3d> points = chain.points;
      if (chain.is_closed) points.push_back(points.front());
      if ((points.front() - points.back()).norm() > 0 || points.size() > 2)
        out.push_back(targets::SpaceCurve(points).evenly(points_per_rib));
    }
  };
  for (int k = 0; k < lines_of_surface; ++k) {
    const double part = (k + 0.5) / lines_of_surface;
    add(targets::Plane(Vector3d::UnitY(), -(box.min().y() + part * box.sizes().y())));
  }
  add(targets::Plane(Vector3d::UnitX(), 0));
  return out;
}

/// Section of a result for ribs over a surface.
class SurfaceRibs final : public RibsOutcome {
 public:
  SurfaceRibs(const RibsTask& task, RibsFile file, optim::RibsDesign found)
      : RibsOutcome(task, std::move(found)), file_(std::move(file)) {}

  void evaluate(const model::Lattice&, StateOf of, const model::State&, RibsMeasure& measure) const override {
    SurfaceMethod method = fishbone_method(design, file_.surface);
    method.rms = measure.error.rms / file_.surface.diagonal;
    method.max = measure.error.max / file_.surface.diagonal;
    measure.methods = {method};
    if (!is_near(method))
      measure.violations.push_back(
          fmt::format("{}: the bodies are {:.2f} % of the diagonal off the surface; at most {:.2f} % is "
                      "allowed; smaller `structure.cell_mm` follow it closer",
                      describe(of), 100 * method.rms, 100 * file_.shape_tolerance));
  }

  std::vector<std::string> bare() const override {
    if (cover.share >= file_.covered_tolerance) return {};
    return {fmt::format(
        "model: {:.0f} % of the surface's area lies within a cell edge of a rib; at least {:.0f} % is "
        "required (`tolerance.covered_share`). More ribs are narrower: try more and fewer `target.ribs`, or "
        "reduce that tolerance",
        100 * cover.share, 100 * file_.covered_tolerance)};
  }

  std::vector<SurfaceMethod> other_methods(const std::stop_token& stop) const override {
    return rib_methods(file_.surface, file_.spec, false, stop);
  }

  void add_sections(const Run& run, Json& result) const override {
    const Vector3d size = bounds(file_.surface.surface.mesh()).sizes();
    const auto drawn = lines_of(file_.surface);
    result["target"] = {{"kind", "surface"},
                        {"name", file_.surface_name},
                        {"size_mm", {size.y(), size.x()}},
                        {"lines_mm", lines(drawn)}};
    const std::vector<SurfaceMethod>& methods = measure_of<RibsMeasure>(run).methods;
    const SurfaceMethod& method = methods.front();
    result["surface"] = {{"lines_mm", lines(drawn)},
                         {"bare_mm", bare_lines(drawn)},
                         {"diagonal_mm", file_.surface.diagonal},
                         {"rms", method.rms},
                         {"max", method.max},
                         {"cover", 1 - method.open},
                         {"covered_share", cover.share},
                         {"goal_rms", cover.rms / file_.surface.diagonal},
                         {"goal_max", cover.max / file_.surface.diagonal},
                         {"ribs", ribs()},
                         {"spine_cells", design.layout.spine_and_ribs.rows},
                         {"spine_mm", line(design.layout.spine.evenly(points_per_rib))},
                         {"cells_trimmed", design.trimmed},
                         {"body_mm", design.error.of_body},
                         {"ways", methods_json(methods)},
                         {"reasons", run.violations},
                         {"reasons_physics", run.physics_violations()}};
    result["optimiser"] = search_json(design.search);
  }

  void add_metrics(const Run& run, Json& metrics) const override {
    const SurfaceMethod& method = measure_of<RibsMeasure>(run).methods.front();
    metrics["surface_rms"] = method.rms;
    metrics["surface_max"] = method.max;
    metrics["cover"] = 1 - method.open;
    metrics["covered_share"] = cover.share;
    metrics["goal_rms"] = cover.rms / file_.surface.diagonal;
    metrics["goal_max"] = cover.max / file_.surface.diagonal;
    metrics["met"] = run.met();
  }

  std::vector<SummaryLine> summary_lines(const Run& run) const override {
    const std::vector<SurfaceMethod>& methods = measure_of<RibsMeasure>(run).methods;
    const SurfaceMethod& method = methods.front();
    std::vector<SummaryLine> out;
    out.push_back(
        {"surface",
         fmt::format("{} mm rms from the surface, limit {} mm; {:.0f} % of it near a rib, limit {:g} %",
                     format_figures(method.rms * file_.surface.diagonal),
                     format_figures(file_.shape_tolerance * file_.surface.diagonal), 100 * cover.share,
                     100 * file_.covered_tolerance)});
    out.push_back(
        {"ribs",
         fmt::format(
             "{} on a spine of {} cells of {:.3g} mm{}", design.layout.spine_and_ribs.ribs.size(),
             design.layout.spine_and_ribs.rows, file_.spec.size.edge_mm,
             design.trimmed > 0 ? fmt::format(", {} cells shorter so that none meet", design.trimmed) : "")});
    out.push_back(
        {"bare", fmt::format("surface {:.3g} mm rms from the nearest rib, {:.3g} mm at most; cells cover "
                             "{:.0f} % of it",
                             cover.rms, cover.max, 100 * (1 - method.open))});
    if (methods.size() > 1) out.push_back({"others", app::describe({methods.begin() + 1, methods.end()})});
    out.push_back(search_line(run.timings.optimise, design.search));
    if (const auto* physics = physics_measure_of<RibsMeasure>(run))
      out.push_back(
          {"check", fmt::format("in the simulation: {} mm rms from the surface, {} mm at most",
                                format_figures(physics->methods.front().rms * file_.surface.diagonal),
                                format_figures(physics->methods.front().max * file_.surface.diagonal))});
    return out;
  }

 private:
  bool is_near(const SurfaceMethod& method) const { return method.rms <= file_.shape_tolerance; }

  RibsFile file_;
};

}  // namespace

std::unique_ptr<Goal> make_goal(RibsFile file) {
  RibsTask task{.name = file.name,
                .settings = file,
                .spec = file.spec,
                .over = file.surface.surface,
                .to_given = file.surface.to_given};
  task.plan = [file] { return plan_ribs(file.surface, file.spec); };
  task.rms_mm = file.shape_tolerance * file.surface.diagonal;
  task.tolerances = {{"shape", file.shape_tolerance}, {"covered_share", file.covered_tolerance}};
  task.folded_mm = bounds(file.surface.surface.mesh()).sizes();
  task.outcome = [task, file](optim::RibsDesign found) {
    return std::make_unique<SurfaceRibs>(task, file, std::move(found));
  };
  return make_ribs_goal(std::move(task));
}

}  // namespace kinetix::app
