#include "app/exports/crease_export.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "model/base/angle.hpp"
#include "model/base/invalid_input.hpp"
#include "model/lattice/crease_law.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;
using Edge = model::CreasePattern::Edge;

constexpr std::string_view file_name = "creases.fold";  // what the run leaves, in the folder of its results

Json points_json(const auto& points) {
  Json out = Json::array();
  for (const auto& p : points) out.push_back(std::vector<double>(p.data(), p.data() + p.size()));
  return out;
}

std::string letter_of(const Edge& edge) { return edge.crease < 0 ? "B" : edge.multiplier > 0 ? "V" : "M"; }

/// deg; of an edge at the rim there is none.
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

std::vector<NamedContent> write_creases(const Run& run, const nlohmann::ordered_json&) {
  const model::PlanarStructure* planar = run.design.structure.planar();
  if (!planar || run.plan.exact.name != model::creased_family) return {};
  try {
    const model::CreasePattern pattern = crease_pattern(*planar, redrawing_of(*planar).y, run.theta);
    return {{std::string(file_name), origami_text(pattern, run.theta, run.design.name)}};
  } catch (const InvalidInput&) {
    return {};  // facets that are no polygons have no place in such a file
  }
}

}  // namespace

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

// Name, extensions, whether every run writes it, and how: the FOLD file.
const Exporter crease_export = {
    "creases", {file_name.substr(file_name.rfind('.') + 1)}, false, write_creases};

}  // namespace kinetix::app
