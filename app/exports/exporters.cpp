#include "app/exports/exporters.hpp"

#include <fmt/format.h>
#include <filesystem>

#include "app/files/bodies_section.hpp"
#include "app/io/bytes.hpp"
#include "app/report/report.hpp"
#include "app/result/result_json.hpp"
#include "app/result/state_json.hpp"
#include "app/viewer/assets.hpp"
#include "model/lattice/planar/creased_motion.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;
using Edge = model::CreasePattern::Edge;

constexpr std::size_t max_triangles = 200'000;             // triangles of bodies in a report: a page of 5 MB
constexpr int max_bodies_of_card = 400;                    // bodies in a report's card: pictures of 300 kB
constexpr std::string_view creases_name = "creases.fold";  // in the folder of results

std::vector<NamedContent> write_design(const Run& run, const Json&) {
  return design_files(written_design(run));
}

Json points_json(const auto& points) {
  Json out = Json::array();
  for (const auto& p : points) out.push_back(std::vector<double>(p.data(), p.data() + p.size()));
  return out;
}

std::string letter_of(const Edge& edge) { return edge.crease < 0 ? "B" : edge.multiplier > 0 ? "V" : "M"; }

/// Lists the fold angle of each edge in degrees; null for edges at the boundary.
Json fold_angles(const model::CreasePattern& pattern, double theta) {
  Json out = Json::array();
  for (const Edge& edge : pattern.edges) {
    if (edge.crease < 0)
      out.push_back(nullptr);
    else
      out.push_back(to_degrees(model::crease_turn(std::atan(edge.multiplier), theta)));
  }
  return out;
}

/// Returns a FOLD file (1.1) in mm: the pattern flat and, as a second frame, folded to theta, rad.
std::string origami_text(const model::CreasePattern& pattern, double theta, const std::string& title) {
  Json edges = Json::array(), words = Json::array();
  for (const Edge& edge : pattern.edges) {
    edges.push_back({edge.from, edge.to});
    words.push_back(letter_of(edge));
  }
  const Json folded = {{"frame_title", "folded"},
                       {"frame_classes", {"foldedForm"}},
                       {"frame_parent", 0},
                       {"frame_inherit", true},
                       {"vertices_coords", points_json(pattern.folded)},
                       {"edges_foldAngle", fold_angles(pattern, theta)}};
  const Json file = {{"file_spec", 1.1},
                     {"file_creator", "kinetix"},
                     {"file_title", title},
                     {"file_classes", {"singleModel"}},
                     {"frame_title", "flat"},
                     {"frame_classes", {"creasePattern"}},
                     {"frame_unit", "mm"},
                     {"vertices_coords", points_json(pattern.flat)},
                     {"edges_vertices", edges},
                     {"edges_assignment", words},
                     {"faces_vertices", pattern.facets},
                     {"file_frames", Json::array({folded})}};
  return file.dump(1) + "\n";
}

std::vector<NamedContent> write_creases(const Run& run, const nlohmann::ordered_json&) {
  const model::PlanarStructure* planar = run.design.structure.planar();
  if (!planar || run.plan.exact.name != model::creased_family) return {};
  try {
    const model::CreasePattern pattern = crease_pattern(*planar, parallel_drawing_of(*planar).y, run.theta);
    return {{std::string(creases_name), origami_text(pattern, run.theta, run.design.name)}};
  } catch (const InvalidInput&) {
    return {};  // the format has no facets that are not polygons
  }
}

std::vector<NamedContent> write_pictures(const Run& run, const Json&) {
  return run.goal ? run.goal->pictures(run, false) : std::vector<NamedContent>{};
}

std::size_t triangles_of(const model::Assembly& bodies) {
  std::size_t count = 0;
  for (const model::AssemblyBody& body : bodies.bodies) count += body.solid.triangles.size();
  for (const model::AssemblyHinge& hinge : bodies.hinges) count += hinge.soft.triangles.size();
  return count;
}

/// Makes report.html with the pictures of the page and the meshes of imported bodies. The time of writing is removed,
/// because it is not known yet.
std::vector<NamedContent> write_report(const Run& run, const Json& result) {
  Json shown = result;
  if (const model::Assembly* bodies = run.design.structure.assembly()) {
    shown["structure"] = shown_bodies_json(*bodies);
    if (triangles_of(*bodies) <= max_triangles) shown["meshes"] = meshes_json(*bodies);
  }
  if (run.print && run.print->draw_card && run.design.structure.bodies() <= max_bodies_of_card)
    shown["card"] = run.print->draw_card(run.folding);
  shown["timing_s"].erase("write");
  if (run.goal)
    for (const auto& [name, png] : run.goal->pictures(run, true))
      shown["pictures"][name] = "data:image/png;base64," + to_base64(png);
  return {{"report.html", report_html(compact_result(std::move(shown), !scene_script().empty()).dump())}};
}

// Name, extensions, whether every run writes it, and how.
const Exporter crease_export = {
    "creases", {creases_name.substr(creases_name.rfind('.') + 1)}, false, write_creases};
const Exporter pictures_export = {"pictures", {"svg", "png"}, false, write_pictures};

std::vector<const Exporter*>& all() {
  static std::vector<const Exporter*> list = {&design_export, &crease_export, &pictures_export,
                                              &report_export};
  return list;
}

constexpr int indent = 1;  // spaces: small, and still one number per line

constexpr const char* design_name = "design.yaml";  // users may change it by hand

void add_files(const Run& run, const nlohmann::ordered_json& result, FileSet& files, FileRecord& record) {
  for (const Exporter* exporter : exporters())
    for (const auto& [name, content] : exporter->write(run, result)) {
      files.add(name, content);
      if (!exporter->of_every_run || name == design_name) record.add(name, content);
    }
}

/// Returns the first unused file name for a changed design in the folder.
std::string name_for_changed_design(const std::string& folder) {
  std::string name = "design_changed.yaml";
  for (int k = 2; std::filesystem::exists(std::filesystem::path(folder) / name); ++k)
    name = fmt::format("design_changed_{}.yaml", k);
  return name;
}

/// Keeps a design.yaml that was changed by hand under a new name. @return that name; "" if it was not changed
std::string keep_changed_design(const std::string& folder, const FileRecord& record, FileSet& files) {
  const auto changed = record.changed(design_name);
  if (!changed) return "";
  const std::string name = name_for_changed_design(folder);
  files.add(name, *changed);
  return name;
}

}  // namespace

const Exporter design_export = {"design", {"yaml", "stl"}, true, write_design};
const Exporter report_export = {"report", {"html"}, true, write_report};

const std::vector<const Exporter*>& exporters() { return all(); }

void add_exporter(const Exporter& exporter) { all().push_back(&exporter); }

WrittenResults write_results(const Run& run, const std::string& folder) {
  Stopwatch watch;
  WrittenResults out{result_json(run), ""};
  FileSet files(folder);
  FileRecord record(folder);
  add_files(run, out.result, files, record);
  out.kept_design = keep_changed_design(folder, record, files);
  files.add(FileRecord::name, record.text());
  out.result["timing_s"]["write"] = watch.lap();
  files.add("result.json", out.result.dump(indent) + "\n");
  files.commit();
  record.remove_leftovers();
  return out;
}

}  // namespace kinetix::app
