#include "app/goals/helmet/helmet_outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "app/result/fishbone_json.hpp"
#include "app/result/state_json.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr int points_a_curve = 60;  // of a line to be drawn: one every 6 mm or so over a head
constexpr int head_curves = 9;      // sections that show the head in the report: enough to see its shape

Json polyline(const targets::Head& head, const std::vector<Eigen::Vector3d>& points) {
  Json out = Json::array();
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector3d q = head.to_mesh * p;
    out.push_back({q.x(), q.y(), q.z()});
  }
  return out;
}

Json polyline(const targets::Head& head, const targets::SpaceCurve& curve) {
  return polyline(head, curve.evenly(points_a_curve));
}

/// The head itself, for pictures: its profile and sections across it, in its own frame.
std::vector<std::vector<Eigen::Vector3d>> head_curves_of(const targets::Head& head) {
  std::vector<std::vector<Eigen::Vector3d>> out = {head.profile.evenly(points_a_curve)};
  for (int k = 0; k < head_curves; ++k) {
    const double s = head.profile.first() + head.profile.length() * (k + 0.5) / head_curves;
    out.push_back(cross_section(head, s, 10).evenly(points_a_curve));
  }
  return out;
}

Json head_lines(const targets::Head& head) {
  Json out = Json::array();
  for (const auto& curve : head_curves_of(head)) out.push_back(polyline(head, curve));
  return out;
}

/// Parts of the lines above the rim that no rib is near to.
Json bare_lines(const HelmetOutcome& helmet) {
  Json out = Json::array();
  for (std::vector<Eigen::Vector3d>& curve : head_curves_of(helmet.head)) {
    std::erase_if(curve, [&](const Eigen::Vector3d& p) { return p.z() < -helmet.spec.coverage_mm; });
    for (const auto& part : bare_parts(helmet.reach, curve)) out.push_back(polyline(helmet.head, part));
  }
  return out;
}

/// Mean of each cell's four bodies, in the order of the structure's cells.
Json by_cell(const model::Structure& structure, const optim::RibsError& error) {
  Json cells = Json::array();
  for (const model::CellHinges& cell : structure.cell_members) {
    double sum = 0;
    for (const int body : cell.bodies) sum += error.of_body[body];
    cells.push_back(sum / 4);
  }
  return cells;
}

double worst_rib(const optim::RibsError& error) {
  return error.of_ribs.empty() ? 0 : *std::max_element(error.of_ribs.begin(), error.of_ribs.end());
}

Json error_json(const optim::RibsError& error) {
  return {{"rms_mm", error.rms}, {"max_mm", error.max}, {"rib_rms_mm", worst_rib(error)}};
}

Json error_json(const optim::RibsError& error, const targets::WallsInside& inside) {
  Json out = error_json(error);
  out["walls_inside"] = inside.hinges.size();
  out["corners_inside"] = inside.corners;
  out["inside_mm"] = inside.depth_mm;
  return out;
}

Json openings_json(const std::vector<targets::DomeOpening>& openings) {
  Json out = Json::array();
  for (const targets::DomeOpening& opening : openings)
    out.push_back({{"width_mm", opening.width_mm}, {"top_mm", opening.top_z}});
  return out;
}

std::string in_words(const optim::RibsError& error) {
  return fmt::format("rms {:.3f} mm, largest {:.3f} mm, ribs up to {:.3f} mm rms from their sections",
                     error.rms, error.max, worst_rib(error));
}

/// Of distances; walls may lie in the head all the same.
bool keeps_tolerances(const HelmetOutcome& helmet, const Run& run) {
  const std::map<std::string, double> most(run.tolerances.begin(), run.tolerances.end());
  const optim::RibsError& error = measure_of<HelmetMeasure>(run).error;
  const auto covered = most.find("covered_share");
  return error.rms <= most.at("rms_mm") && error.max <= most.at("max_mm") &&
         (covered == most.end() || helmet.cover.share >= covered->second);
}

Json helmet_json(const HelmetOutcome& helmet, const Run& run, const model::Structure& structure) {
  const auto& shape = measure_of<HelmetMeasure>(run);
  const optim::RibsDesign& design = helmet.design;
  Json out = {
      {"clearance_mm", helmet.spec.clearance_mm},
      {"coverage_mm", helmet.spec.coverage_mm},
      {"ribs", ribs_json(design)},
      {"spine_cells", design.layout.spine_and_ribs.rows},
      {"error", error_json(shape.error, shape.inside)},
      {"body_mm", shape.error.of_body},
      {"cell_mm", by_cell(structure, shape.error)},
      {"cells_trimmed", design.trimmed},
      {"covered_share", helmet.cover.share},
      {"goal_rms_mm", helmet.cover.rms},
      {"goal_max_mm", helmet.cover.max},
      {"head_mm", head_lines(helmet.head)},
      {"bare_mm", bare_lines(helmet)},
      {"head_frame", poses_json({{helmet.head.to_mesh.linear(), helmet.head.to_mesh.translation()}})[0]},
      {"closed_part", helmet.head.closed_part},
      {"openings", openings_json(helmet.head.openings)},
      {"invented", invented(helmet.head.openings)},
      {"notes", design.layout.notes},
      {"reasons", run.violations},
      {"reasons_physics", run.physics_violations()}};
  if (const auto* physics = physics_measure_of<HelmetMeasure>(run))
    out["physics"] = error_json(physics->error, physics->inside);
  return out;
}

Json optimiser_json(const optim::SolveResult& search) {
  return {{"solver", "ceres"},
          {"starts", 1},
          {"evaluations", search.evaluations},
          {"status", to_string(search.status)},
          {"why", search.why}};
}

}  // namespace

std::string invented(const std::vector<targets::DomeOpening>& openings) {
  if (openings.empty()) return "";
  double widest = 0;
  for (const targets::DomeOpening& opening : openings) widest = std::max(widest, opening.width_mm);
  const std::string holes = openings.size() == 1 ? "a hole" : fmt::format("{} holes", openings.size());
  return fmt::format(
      "the part of the head to be covered has {} in the mesh, {}{:.0f} mm across: there the "
      "helmet follows an invented dome, not the head",
      holes, openings.size() == 1 ? "" : "the widest ", widest);
}

HelmetOutcome::HelmetOutcome(targets::Head head_, optim::HelmetSpec spec_, optim::RibsDesign design_)
    : head(std::move(head_)),
      spec(std::move(spec_)),
      design(std::move(design_)),
      reach(design.fishbone.structure, design.state, head.dome, spec.clearance_mm),
      cover(cover_by(reach, head.dome.mesh(), -spec.coverage_mm)) {}

void HelmetOutcome::add_sections(const Run& run, Json& result) const {
  Json sections = Json::array();
  for (const auto& [lower, upper] : design.layout.sections)
    sections.push_back({polyline(head, lower), polyline(head, upper)});
  result["target"] = {
      {"kind", "helmet"}, {"spine_mm", polyline(head, design.layout.spine)}, {"sections_mm", sections}};
  result["helmet"] = helmet_json(*this, run, design.fishbone.structure);
  result["optimiser"] = optimiser_json(design.search);
}

void HelmetOutcome::add_metrics(const Run& run, Json& metrics) const {
  const auto& shape = measure_of<HelmetMeasure>(run);
  metrics["distance_rms_mm"] = shape.error.rms;
  metrics["distance_max_mm"] = shape.error.max;
  metrics["rib_rms_mm"] = worst_rib(shape.error);
  metrics["covered_share"] = cover.share;
  metrics["goal_rms_mm"] = cover.rms;
  metrics["goal_max_mm"] = cover.max;
  metrics["walls_inside"] = shape.inside.hinges.size();
  metrics["met"] = run.met();
  const auto* physics = physics_measure_of<HelmetMeasure>(run);
  if (!physics) return;
  metrics["distance_rms_mm_physics"] = physics->error.rms;
  metrics["distance_max_mm_physics"] = physics->error.max;
  metrics["walls_inside_physics"] = physics->inside.hinges.size();
}

std::vector<SummaryLine> HelmetOutcome::summary_lines(const Run& run) const {
  std::vector<SummaryLine> lines;
  lines.push_back(
      {"helmet",
       fmt::format("{} ribs on a spine of {} cells, {:g} mm over the head, {:g} mm down from the crown",
                   design.layout.spine_and_ribs.ribs.size(), design.layout.spine_and_ribs.rows,
                   spec.clearance_mm, spec.coverage_mm)});
  lines.push_back(
      {"fit", in_words(measure_of<HelmetMeasure>(run).error) +
                  fmt::format(", {:.0f} % of the head within a cell edge of a rib: ", 100 * cover.share) +
                  tolerance_words(run, keeps_tolerances(*this, run))});
  for (const std::string& note : design.layout.notes) lines.push_back({"note", note});
  lines.push_back({"search", fmt::format("{:.2f} s, ceres, {} evaluations, {}", run.timings.optimise,
                                         design.search.evaluations, to_string(design.search.status))});
  if (const auto* physics = physics_measure_of<HelmetMeasure>(run))
    lines.push_back({"worn", "in the physics run: " + in_words(physics->error)});
  return lines;
}

}  // namespace kinetix::app
