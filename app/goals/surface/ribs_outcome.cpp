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

/// Sections of the surface, across the spine's plane and by it.
Json lines_of(const targets::RibbedSurface& surface) {
  const targets::TriangleMesh mesh = joined(surface.surface.mesh());
  const Eigen::AlignedBox3d box = bounds(mesh);
  Json out = Json::array();
  const auto add = [&](const targets::Plane& plane) {
    for (const targets::SectionChain& chain : section(mesh, plane)) {
      std::vector<Vector3d> points = chain.points;
      if (chain.is_closed) points.push_back(points.front());
      if ((points.front() - points.back()).norm() > 0 || points.size() > 2)
        out.push_back(drawn(surface, targets::SpaceCurve(points).evenly(points_a_rib)));
    }
  };
  for (int k = 0; k < lines_of_surface; ++k) {
    const double part = (k + 0.5) / lines_of_surface;
    add(targets::Plane(Vector3d::UnitY(), -(box.min().y() + part * box.sizes().y())));
  }
  add(targets::Plane(Vector3d::UnitX(), 0));
  return out;
}

}  // namespace

RibsOutcome::RibsOutcome(RibsFile asked, optim::RibsDesign found)
    : file(std::move(asked)), design(std::move(found)), ways({fishbone_way(design, file.surface)}) {}

Json RibsOutcome::target_json() const {
  const Vector3d size = bounds(file.surface.surface.mesh()).sizes();
  return {{"kind", "surface"},
          {"name", file.surface_name},
          {"size_mm", {size.y(), size.x()}},
          {"lines_mm", lines_of(file.surface)}};
}

void RibsOutcome::add_sections(const Run&, Json& result) const {
  const SurfaceWay& way = ways.front();
  result["surface"] = {{"lines_mm", lines_of(file.surface)},
                       {"diagonal_mm", file.surface.diagonal},
                       {"rms", way.rms},
                       {"max", way.max},
                       {"cover", 1 - way.open},
                       {"ribs", ribs_json(design)},
                       {"spine_cells", design.layout.spine_and_ribs.rows},
                       {"spine_mm", drawn(file.surface, design.layout.spine.evenly(points_a_rib))},
                       {"cells_trimmed", design.trimmed},
                       {"body_mm", design.error.of_body},
                       {"ways", ways_json(ways)},
                       {"reasons", violations},
                       {"reasons_physics", physics_violations}};
  result["optimiser"] = {{"solver", "ceres"},
                         {"starts", 1},
                         {"evaluations", design.search.evaluations},
                         {"status", to_string(design.search.status)},
                         {"why", design.search.why}};
}

void RibsOutcome::add_metrics(Json& metrics) const {
  metrics["surface_rms"] = ways.front().rms;
  metrics["surface_max"] = ways.front().max;
  metrics["cover"] = 1 - ways.front().open;
  metrics["met"] = met();
}

std::vector<SummaryLine> RibsOutcome::summary_lines(const Run& run) const {
  const SurfaceWay& way = ways.front();
  std::vector<SummaryLine> lines;
  lines.push_back(
      {"surface", fmt::format("bodies {:.3f} % of the diagonal off it (rms, {:.3f} mm), cells on "
                              "{:.0f} % of its area: {}",
                              100 * way.rms, way.rms * file.surface.diagonal, 100 * (1 - way.open),
                              verdict(app::violations(file, way, "").empty()))});
  for (const std::string& why : violations) lines.push_back({"why", why});
  lines.push_back(
      {"ribs",
       fmt::format(
           "{} on a spine of {} cells of {:.3g} mm{}", design.layout.spine_and_ribs.ribs.size(),
           design.layout.spine_and_ribs.rows, file.spec.size.edge_mm,
           design.trimmed > 0 ? fmt::format(", {} cells shorter so that none meet", design.trimmed) : "")});
  if (ways.size() > 1) lines.push_back({"beside", in_words({ways.begin() + 1, ways.end()})});
  lines.push_back({"search", fmt::format("{:.2f} s, ceres, {} evaluations, {}", run.timings.optimise,
                                         design.search.evaluations, to_string(design.search.status))});
  if (settled)
    lines.push_back({"settled", fmt::format("in the physics run: bodies {:.3f} % off, largest {:.3f} %",
                                            100 * settled->rms, 100 * settled->max)});
  for (const std::string& why : physics_violations) lines.push_back({"why", why});
  return lines;
}

std::vector<std::string> violations(const RibsFile& file, const SurfaceWay& way, const std::string& who) {
  std::vector<std::string> why;
  if (!(way.rms <= file.shape_tolerance))
    why.push_back(
        fmt::format("{}: the bodies are {:.2f} % of the diagonal off the surface; at most {:.2f} % is "
                    "allowed; smaller `structure.cell_mm` follow it closer",
                    who, 100 * way.rms, 100 * file.shape_tolerance));
  if (!(1 - way.open >= file.cover_tolerance))
    why.push_back(
        fmt::format("{}: cells cover {:.0f} % of the area; at least {:.0f} % is asked; more "
                    "`target.ribs` cover more",
                    who, 100 * (1 - way.open), 100 * file.cover_tolerance));
  return why;
}

}  // namespace kinetix::app
