#include "app/goals/surface/surface_outcome.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/result/search_json.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr int grid_lines = 9;    // of the surface in pictures, each way: its shape shows between them
constexpr int grid_points = 25;  // on each line: they look smooth on a page

Json point(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

Json grid(const targets::SurfacePatch& patch) {
  Json lines = Json::array();
  for (const bool along_x : {true, false})
    for (int k = 0; k < grid_lines; ++k) {
      Json line = Json::array();
      for (int p = 0; p < grid_points; ++p) {
        const double across = 2.0 * k / (grid_lines - 1) - 1, along = 2.0 * p / (grid_points - 1) - 1;
        const Eigen::Vector2d at = patch.half.cwiseProduct(along_x ? Eigen::Vector2d(along, across)
                                                                   : Eigen::Vector2d(across, along));
        line.push_back(point({at.x(), at.y(), patch.height(at).z}));
      }
      lines.push_back(line);
    }
  return lines;
}

/// What the folded sheet lacks of the surface.
std::vector<std::string> why_off_surface(const SurfaceOutcome& o) {
  std::vector<std::string> why;
  const optim::SurfaceError& error = o.design.error;
  if (!(error.rms <= o.file.shape_tolerance))
    why.push_back(
        fmt::format("model: the vertices are {:.2f} % of the diagonal off the surface; at most {:.2f} % is "
                    "allowed{}",
                    100 * error.rms, 100 * o.file.shape_tolerance,
                    std::isfinite(o.curvature.share)
                        ? fmt::format("; the sheet has {:.0f} % of its curvature", 100 * o.curvature.share)
                        : ""));
  if (!(error.cover >= o.file.cover_tolerance))
    why.push_back(fmt::format("model: {:.0f} % of the area is shared; at least {:.0f} % is asked",
                              100 * error.cover, 100 * o.file.cover_tolerance));
  if (!o.needs_curvature()) return why;
  if (!(o.curvature.share >= o.file.curvature_tolerance))
    why.push_back(fmt::format(
        "model: the sheet has {:.0f} % of the surface's Gauss curvature; at least {:.0f} % is required "
        "(`tolerance.curvature_share`). Allow more in `variables.edge` and `variables.sector_deg`, or take "
        "`target.ribs`",
        100 * o.curvature.share, 100 * o.file.curvature_tolerance));
  if (!(error.rms <= most_of_cone * o.cone_rms))
    why.push_back(
        fmt::format("model: the vertices are {:.2f} % of the diagonal off the surface, the best cylinder or "
                    "cone {:.2f} %; "
                    "at most half of that is allowed",
                    100 * error.rms, 100 * o.cone_rms));
  return why;
}

Json degrees(const std::array<double, 2>& range) { return {to_degrees(range[0]), to_degrees(range[1])}; }

}  // namespace

void SurfaceOutcome::add_sections(const Run& run, Json& result) const {
  result["target"] = {{"kind", "surface"},
                      {"name", file.patch.name},
                      {"size_mm", {2 * file.patch.half.x(), 2 * file.patch.half.y()}},
                      {"lines_mm", grid(file.patch)}};
  Json vertices = Json::array(), flat = Json::array();
  for (const Eigen::Vector3d& vertex : design.vertices) vertices.push_back(point(vertex));
  for (const Eigen::Vector2d& vertex : design.mesh.vertices) flat.push_back({vertex.x(), vertex.y()});
  result["surface"] = {{"facets", {design.mesh.columns, design.mesh.rows}},
                       {"lines_mm", grid(file.patch)},
                       {"vertices_mm", vertices},
                       {"flat_mm", flat},
                       {"multipliers", {{"rising", design.mesh.rising}, {"level", design.mesh.level}}},
                       {"diagonal_mm", diagonal_mm},
                       {"layer_mm", design.layer},
                       {"rms", design.error.rms},
                       {"max", design.error.max},
                       {"cover", design.error.cover},
                       {"sector_deg", degrees(design.sector)},
                       {"edge", design.edge},
                       {"beta_deg", to_degrees(design.tilt)},
                       {"free_height", free_height},
                       {"walls_meet", !clear},
                       {"curvature_missing", 1 - curvature.share},
                       {"ways", ways_json(measure_of<SurfaceMeasure>(run).ways)},
                       {"reasons", run.violations}};
  result["optimiser"] = {{"solver", "ceres"}, {"starts", design.starts}, {"evaluations", design.evaluations}};
  add_end(design.stopped, design.within, "the best of all starts keeps to its bounds",
          "no start led to a mesh that keeps to its bounds", result["optimiser"]);
}

void SurfaceOutcome::add_metrics(const Run& run, Json& metrics) const {
  metrics["surface_rms"] = design.error.rms;
  metrics["surface_max"] = design.error.max;
  metrics["cover"] = design.error.cover;
  metrics["free_height"] = free_height;
  metrics["curvature_share"] = curvature.share;
  metrics["developable_rms"] = cone_rms;
  metrics["met"] = run.met();
}

std::vector<SummaryLine> SurfaceOutcome::summary_lines(const Run& run) const {
  std::vector<SummaryLine> lines;
  lines.push_back(
      {"surface",
       fmt::format(
           "vertices {:.2f} % of the diagonal off its two layers (rms, {:.3f} mm), area {:.0f} % shared: {}",
           100 * design.error.rms, design.error.rms * diagonal_mm, 100 * design.error.cover,
           tolerance_words(run, why_off_surface(*this).empty()))});
  if (needs_curvature())
    lines.push_back(
        {"curvature",
         fmt::format("{:.0f} % of the surface's Gauss curvature; the best cylinder or cone is {:.2f} % "
                     "of the diagonal off the surface",
                     100 * curvature.share, 100 * cone_rms)});
  lines.push_back({"mesh", fmt::format("{} x {} facets, edges {:.2f} to {:.2f} of their mean, sectors {:.0f} "
                                       "to {:.0f} deg, tilts up to {:.1f} deg",
                                       design.mesh.columns, design.mesh.rows, design.edge[0], design.edge[1],
                                       to_degrees(design.sector[0]), to_degrees(design.sector[1]),
                                       to_degrees(design.tilt))});
  const double edge = run.design.structure.size().edge_mm;
  lines.push_back(
      {"walls",
       fmt::format("a mean wall is {:.2f} mm; {}", edge,
                   free_height > 0 ? fmt::format("plates up to {:.2f} mm high never meet", free_height * edge)
                                   : "plates of any height meet on the way")});
  const std::vector<SurfaceWay>& ways = measure_of<SurfaceMeasure>(run).ways;
  if (ways.size() > 1) lines.push_back({"beside", in_words({ways.begin() + 1, ways.end()})});
  lines.push_back(
      {"search", fmt::format("{:.2f} s, {} evaluations", run.timings.optimise, design.evaluations)});
  return lines;
}

std::vector<std::string> violations(const SurfaceOutcome& o) {
  std::vector<std::string> why = why_off_surface(o);
  if (!o.design.within)
    why.push_back("no flat-foldable mesh within the bounds of its sectors, edges and tilts was found");
  if (!o.clear)
    why.push_back(
        o.free_height > 0
            ? fmt::format("walls meet on the way; plates up to {:.3f} walls high would not", o.free_height)
            : "walls meet on the way whatever their height");
  return why;
}

}  // namespace kinetix::app
