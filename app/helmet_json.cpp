#include "app/helmet_json.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/state_json.hpp"

namespace kinetix {
namespace {

using Json = nlohmann::ordered_json;

constexpr int points_a_curve = 60;
constexpr int head_curves = 9;

Json polyline(const Head& head, const SpaceCurve& curve) {
  Json out = Json::array();
  for (const auto& p : curve.evenly(points_a_curve)) {
    const Eigen::Vector3d q = head.to_mesh * p;
    out.push_back({q.x(), q.y(), q.z()});
  }
  return out;
}

/// The head itself, for pictures: its profile and sections across it.
Json head_lines(const Head& head) {
  Json out = Json::array({polyline(head, head.profile)});
  for (int k = 0; k < head_curves; ++k) {
    const double s = head.profile.first() + head.profile.length() * (k + 0.5) / head_curves;
    out.push_back(polyline(head, cross_section(head, s, 10)));
  }
  return out;
}

Json ribs_json(const HelmetDesign& design) {
  Json ribs = Json::array();
  for (std::size_t r = 0; r < design.layout.bones.ribs.size(); ++r) {
    const FishboneRib& rib = design.layout.bones.ribs[r];
    ribs.push_back({{"row", rib.row}, {"cells", rib.cells}, {"rms_mm", design.error.of_ribs[r]}});
  }
  return ribs;
}

/// Mean of each cell's four bodies, in the order of the structure's cells.
Json by_cell(const Structure& structure, const HelmetError& error) {
  Json cells = Json::array();
  for (const CellHinges& cell : structure.cell_members) {
    double sum = 0;
    for (const int body : cell.bodies) sum += error.of_body[body];
    cells.push_back(sum / 4);
  }
  return cells;
}

double worst_rib(const HelmetError& error) {
  return error.of_ribs.empty() ? 0 : *std::max_element(error.of_ribs.begin(), error.of_ribs.end());
}

Json error_json(const HelmetError& error) {
  return {{"rms_mm", error.rms}, {"max_mm", error.max}, {"rib_rms_mm", worst_rib(error)}};
}

std::string in_words(const HelmetError& error) {
  return fmt::format("rms {:.3f} mm, largest {:.3f} mm, ribs up to {:.3f} mm rms from their sections",
                     error.rms, error.max, worst_rib(error));
}

}  // namespace

Json helmet_json(const Run& run) {
  const HelmetOutcome& helmet = *run.helmet;
  const HelmetDesign& design = helmet.design;
  Json out = {
      {"clearance_mm", helmet.wish.clearance_mm},
      {"coverage_mm", helmet.wish.coverage_mm},
      {"ribs", ribs_json(design)},
      {"spine_cells", design.layout.bones.rows},
      {"error", error_json(design.error)},
      {"body_mm", design.error.of_body},
      {"cell_mm", by_cell(run.structure, design.error)},
      {"cells_trimmed", design.trimmed},
      {"head_mm", head_lines(helmet.head)},
      {"head_frame", poses_json({{helmet.head.to_mesh.linear(), helmet.head.to_mesh.translation()}})[0]},
      {"closed_part", helmet.head.closed_part},
      {"uniform",
       {{"tilt_deg", to_degrees(helmet.uniform.tilt)},
        {"theta_deg", to_degrees(helmet.uniform.theta)},
        {"before", error_json(helmet.uniform.before)},
        {"after", error_json(helmet.uniform.after)}}},
      {"notes", design.layout.notes},
      {"reasons", helmet.why_missed},
      {"reasons_physics", helmet.why_physics}};
  if (helmet.physics) out["physics"] = error_json(*helmet.physics);
  return out;
}

Json helmet_target_json(const HelmetOutcome& helmet) {
  Json sections = Json::array();
  for (const auto& [lower, upper] : helmet.design.layout.sections)
    sections.push_back({polyline(helmet.head, lower), polyline(helmet.head, upper)});
  return {{"kind", "helmet"},
          {"spine_mm", polyline(helmet.head, helmet.design.layout.spine)},
          {"sections_mm", sections}};
}

Json helmet_optimiser_json(const HelmetOutcome& helmet) {
  const SolveResult& search = helmet.design.search;
  return {{"solver", "ceres"},
          {"starts", 1},
          {"evaluations", search.evaluations},
          {"status", to_string(search.status)},
          {"why", search.why}};
}

void add_helmet_metrics(const HelmetOutcome& helmet, Json& metrics) {
  const HelmetError& error = helmet.design.error;
  metrics["distance_rms_mm"] = error.rms;
  metrics["distance_max_mm"] = error.max;
  metrics["rib_rms_mm"] = worst_rib(error);
  metrics["uniform_rms_mm"] = helmet.uniform.after.rms;
  metrics["met"] = helmet.met();
  if (!helmet.physics) return;
  metrics["distance_rms_mm_physics"] = helmet.physics->rms;
  metrics["distance_max_mm_physics"] = helmet.physics->max;
}

std::vector<std::array<std::string, 2>> helmet_lines(const Run& run) {
  const HelmetOutcome& helmet = *run.helmet;
  std::vector<std::array<std::string, 2>> lines;
  lines.push_back(
      {"helmet", fmt::format("{} ribs on a spine of {} cells, {:g} mm over the head, {:g} mm down from "
                             "the crown",
                             helmet.design.layout.bones.ribs.size(), helmet.design.layout.bones.rows,
                             helmet.wish.clearance_mm, helmet.wish.coverage_mm)});
  lines.push_back({"fit", in_words(helmet.design.error) +
                              (helmet.met() ? ": within tolerance" : ": MISSES WHAT IS ASKED")});
  for (const std::string& why : helmet.why_missed) lines.push_back({"why", why});
  for (const std::string& note : helmet.design.layout.notes) lines.push_back({"note", note});
  lines.push_back({"one tilt", fmt::format("the same for all walls: rms {:.2f} mm, largest {:.2f} mm at best",
                                           helmet.uniform.after.rms, helmet.uniform.after.max)});
  lines.push_back(
      {"search", fmt::format("{:.2f} s, ceres, {} evaluations, {}", run.timings.optimise,
                             helmet.design.search.evaluations, to_string(helmet.design.search.status))});
  if (helmet.physics) lines.push_back({"worn", "in the physics run: " + in_words(*helmet.physics)});
  for (const std::string& why : helmet.why_physics) lines.push_back({"why", why});
  return lines;
}

}  // namespace kinetix
