#include "app/goals/surface/ribs_outcome.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/result/fishbone_json.hpp"
#include "app/run/run.hpp"
#include "targets/mesh/mesh_section.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;
using Eigen::Vector3d;

constexpr int lines_of_surface = 11;  // across the spine: they show the shape
constexpr int points_a_rib = 60;      // of a line to be drawn: it looks smooth on a page

Json drawn(const targets::RibbedSurface& surface, const std::vector<Vector3d>& line) {
  Json out = Json::array();
  for (const Vector3d& p : line) {
    const Vector3d q = surface.to_given * p;
    out.push_back({q.x(), q.y(), q.z()});
  }
  return out;
}

/// Sections of the surface, across the spine's plane and by it, in the frame of the ribs.
std::vector<std::vector<Vector3d>> lines_of(const targets::RibbedSurface& surface) {
  const targets::TriangleMesh mesh = joined(surface.surface.mesh());
  const Eigen::AlignedBox3d box = bounds(mesh);
  std::vector<std::vector<Vector3d>> out;
  const auto add = [&](const targets::Plane& plane) {
    for (const targets::SectionChain& chain : section(mesh, plane)) {
      std::vector<Vector3d> points = chain.points;
      if (chain.is_closed) points.push_back(points.front());
      if ((points.front() - points.back()).norm() > 0 || points.size() > 2)
        out.push_back(targets::SpaceCurve(points).evenly(points_a_rib));
    }
  };
  for (int k = 0; k < lines_of_surface; ++k) {
    const double part = (k + 0.5) / lines_of_surface;
    add(targets::Plane(Vector3d::UnitY(), -(box.min().y() + part * box.sizes().y())));
  }
  add(targets::Plane(Vector3d::UnitX(), 0));
  return out;
}

Json lines_json(const targets::RibbedSurface& surface) {
  Json out = Json::array();
  for (const std::vector<Vector3d>& line : lines_of(surface)) out.push_back(drawn(surface, line));
  return out;
}

/// Parts of the lines that no rib is near to.
Json bare_lines_json(const targets::RibbedSurface& surface, const optim::RibsReach& reach) {
  Json out = Json::array();
  for (const std::vector<Vector3d>& line : lines_of(surface))
    for (const std::vector<Vector3d>& part : bare_parts(reach, line)) out.push_back(drawn(surface, part));
  return out;
}

}  // namespace

RibsOutcome::RibsOutcome(RibsFile asked, optim::RibsDesign found)
    : file(std::move(asked)),
      design(std::move(found)),
      reach(design.fishbone.structure, design.state, file.surface.surface, file.spec.clearance_mm),
      cover(cover_by(reach, file.surface.surface.mesh())) {}

void RibsOutcome::add_sections(const Run& run, Json& result) const {
  const Vector3d size = bounds(file.surface.surface.mesh()).sizes();
  result["target"] = {{"kind", "surface"},
                      {"name", file.surface_name},
                      {"size_mm", {size.y(), size.x()}},
                      {"lines_mm", lines_json(file.surface)}};
  const std::vector<SurfaceWay>& ways = measure_of<RibsMeasure>(run).ways;
  const SurfaceWay& way = ways.front();
  result["surface"] = {{"lines_mm", lines_json(file.surface)},
                       {"bare_mm", bare_lines_json(file.surface, reach)},
                       {"diagonal_mm", file.surface.diagonal},
                       {"rms", way.rms},
                       {"max", way.max},
                       {"cover", 1 - way.open},
                       {"covered_share", cover.share},
                       {"goal_rms", cover.rms / file.surface.diagonal},
                       {"goal_max", cover.max / file.surface.diagonal},
                       {"ribs", ribs_json(design)},
                       {"spine_cells", design.layout.spine_and_ribs.rows},
                       {"spine_mm", drawn(file.surface, design.layout.spine.evenly(points_a_rib))},
                       {"cells_trimmed", design.trimmed},
                       {"body_mm", design.error.of_body},
                       {"ways", ways_json(ways)},
                       {"reasons", run.violations},
                       {"reasons_physics", run.physics_violations()}};
  result["optimiser"] = {{"solver", "ceres"},
                         {"starts", 1},
                         {"evaluations", design.search.evaluations},
                         {"status", to_string(design.search.status)},
                         {"why", design.search.why}};
}

void RibsOutcome::add_metrics(const Run& run, Json& metrics) const {
  const SurfaceWay& way = measure_of<RibsMeasure>(run).ways.front();
  metrics["surface_rms"] = way.rms;
  metrics["surface_max"] = way.max;
  metrics["cover"] = 1 - way.open;
  metrics["covered_share"] = cover.share;
  metrics["goal_rms"] = cover.rms / file.surface.diagonal;
  metrics["goal_max"] = cover.max / file.surface.diagonal;
  metrics["met"] = run.met();
}

std::vector<SummaryLine> RibsOutcome::summary_lines(const Run& run) const {
  const std::vector<SurfaceWay>& ways = measure_of<RibsMeasure>(run).ways;
  const SurfaceWay& way = ways.front();
  std::vector<SummaryLine> lines;
  const bool is_within = app::violations(file, way, "").empty() && app::violations(file, cover).empty();
  lines.push_back(
      {"surface", fmt::format("bodies {:.3f} % of the diagonal off it (rms, {:.3f} mm), {:.0f} % of its area "
                              "within a cell edge of a rib: {}",
                              100 * way.rms, way.rms * file.surface.diagonal, 100 * cover.share,
                              tolerance_words(run, is_within))});
  lines.push_back(
      {"ribs",
       fmt::format(
           "{} on a spine of {} cells of {:.3g} mm{}", design.layout.spine_and_ribs.ribs.size(),
           design.layout.spine_and_ribs.rows, file.spec.size.edge_mm,
           design.trimmed > 0 ? fmt::format(", {} cells shorter so that none meet", design.trimmed) : "")});
  lines.push_back(
      {"bare",
       fmt::format("the surface is {:.3g} mm from the nearest rib (rms), {:.3g} mm at most; cells lie on "
                   "{:.0f} % of its area",
                   cover.rms, cover.max, 100 * (1 - way.open))});
  if (ways.size() > 1) lines.push_back({"beside", in_words({ways.begin() + 1, ways.end()})});
  lines.push_back({"search", fmt::format("{:.2f} s, ceres, {} evaluations, {}", run.timings.optimise,
                                         design.search.evaluations, to_string(design.search.status))});
  if (const auto* physics = physics_measure_of<RibsMeasure>(run))
    lines.push_back(
        {"settled", fmt::format("in the physics run: bodies {:.3f} % off, largest {:.3f} %",
                                100 * physics->ways.front().rms, 100 * physics->ways.front().max)});
  return lines;
}

std::vector<std::string> violations(const RibsFile& file, const SurfaceWay& way, const std::string& who) {
  std::vector<std::string> why;
  if (!(way.rms <= file.shape_tolerance))
    why.push_back(
        fmt::format("{}: the bodies are {:.2f} % of the diagonal off the surface; at most {:.2f} % is "
                    "allowed; smaller `structure.cell_mm` follow it closer",
                    who, 100 * way.rms, 100 * file.shape_tolerance));
  return why;
}

std::vector<std::string> violations(const RibsFile& file, const optim::RibsCover& cover) {
  if (cover.share >= file.covered_tolerance) return {};
  return {fmt::format(
      "model: {:.0f} % of the surface's area lies within a cell edge of a rib; at least {:.0f} % is "
      "required (`tolerance.covered_share`). Give more `target.ribs`",
      100 * cover.share, 100 * file.covered_tolerance)};
}

}  // namespace kinetix::app
