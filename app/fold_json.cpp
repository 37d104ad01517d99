#include "app/fold_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kinetix {
namespace {

using Json = nlohmann::ordered_json;

std::vector<double> in_degrees(std::vector<double> angles) {
  for (double& angle : angles) angle = to_degrees(angle);
  return angles;
}

Json faces_json(const FoldOutcome& fold) {
  const FoldedNet& net = fold.design.folded;
  Json faces = Json::array();
  for (std::size_t f = 0; f < net.net.faces.size(); ++f) {
    const PlacedFace& placed = net.layout.faces[f];
    faces.push_back({{"name", net.net.faces[f].name},
                     {"cell", {placed.i, placed.j}},
                     {"cells", {placed.width, placed.height}},
                     {"rms", net.error.face_rms[f]}});
    if (fold.physics) faces.back()["rms_physics"] = fold.physics->face_rms[f];
  }
  return faces;
}

Json crease_json(const FoldOutcome& fold, std::size_t c) {
  const FoldedNet& net = fold.design.folded;
  const PlacedCrease& placed = net.layout.creases[c];
  const bool along_x = placed.axis == Axis::x;
  Json out = {{"name", crease_name(net.net, net.net.creases[c])},
              {"faces", {net.net.creases[c].first, net.net.creases[c].second}},
              {"axis", along_x ? "x" : "y"},
              {"cell", {placed.i, placed.j}},
              {"cells", {along_x ? placed.columns : placed.length, along_x ? placed.length : placed.columns}},
              {"columns", placed.columns},
              {"angle_deg", to_degrees(net.net.creases[c].angle)},
              {"fold_deg", to_degrees(net.error.fold[c])},
              {"tilt_deg", to_degrees(net.tilt[c])}};
  if (fold.physics) out["fold_physics_deg"] = to_degrees(fold.physics->fold[c]);
  return out;
}

Json attempts_json(const FoldDesign& design) {
  Json out = Json::array();
  for (const FoldAttempt& attempt : design.attempts)
    out.push_back({{"unfolding", attempt.net}, {"columns", attempt.columns}, {"why", attempt.why}});
  return out;
}

/// Edges of the ideal box: faces of a, b and c pitches, and what the creases add at both ends.
std::array<double, 3> box_edges(const FoldOutcome& fold) {
  const FoldedNet& net = fold.design.folded;
  const double pitch = net.structure.size.edge_mm * std::cos(net.theta);
  std::array<double, 3> edges;
  for (int k = 0; k < 3; ++k)
    edges[k] = pitch * ((*fold.goal.box)[k] + 2 * edge_inset(pi / 2, net.layout.creases[0].columns));
  return edges;
}

double largest_miss(const FoldNet& net, const FoldError& error) {
  double most = 0;
  for (std::size_t c = 0; c < net.creases.size(); ++c)
    most = std::max(most, std::abs(error.fold[c] - net.creases[c].angle));
  return most;
}

std::string in_words(const FoldNet& net, const FoldError& error) {
  return fmt::format("{} creases within {:.1e} deg, faces {:.1e} of their edge from the solid (rms)",
                     net.creases.size(), to_degrees(largest_miss(net, error)), error.rms);
}

/// "2 columns", or "1 to 4 columns"
std::string columns_in_words(const NetLayout& layout) {
  int least = max_crease_columns, most = 0;
  for (const PlacedCrease& crease : layout.creases) {
    least = std::min(least, crease.columns);
    most = std::max(most, crease.columns);
  }
  if (least >= most) return fmt::format("{} {}", most, most == 1 ? "column" : "columns");
  return fmt::format("{} to {} columns", least, most);
}

}  // namespace

Json fold_json(const Run& run) {
  const FoldOutcome& fold = *run.fold;
  const FoldDesign& design = fold.design;
  Json creases = Json::array();
  for (std::size_t c = 0; c < design.folded.net.creases.size(); ++c) creases.push_back(crease_json(fold, c));
  Json out = {{"faces", faces_json(fold)},           {"creases", creases},
              {"unfoldings", fold.goal.nets.size()}, {"unfolding", design.net},
              {"attempts", attempts_json(design)},   {"reasons", fold.why_missed},
              {"reasons_physics", fold.why_physics}};
  if (fold.goal.box) out["edges_mm"] = box_edges(fold);
  return out;
}

Json fold_target_json(const FoldOutcome& fold) {
  const FoldNet& net = fold.design.folded.net;
  Json out = {{"kind", "fold"}};
  if (fold.goal.box) out["box"] = *fold.goal.box;
  if (fold.goal.open) out["open"] = box_face_names()[*fold.goal.open];
  out["faces"] = Json::array();
  for (const FoldFace& face : net.faces)
    out["faces"].push_back({{"name", face.name}, {"cells", {face.width, face.height}}});
  out["creases"] = Json::array();
  for (const FoldCrease& crease : net.creases)
    out["creases"].push_back({{"faces", {net.faces[crease.first].name, net.faces[crease.second].name}},
                              {"side", to_string(crease.side)},
                              {"angle_deg", to_degrees(crease.angle)},
                              {"shift", crease.shift}});
  return out;
}

Json fold_optimiser_json(const FoldOutcome& fold) {
  return {{"solver", "closed form"},
          {"starts", fold.design.attempts.size()},
          {"evaluations", fold.design.evaluations},
          {"status", fold.design.folds ? "converged" : "failed"},
          {"why", fold.design.folds ? "every crease reaches its angle at one theta, with no wall in the way"
                                    : "no unfolding and no number of columns tried folds freely"}};
}

void add_fold_metrics(const FoldOutcome& fold, Json& metrics) {
  const FoldedNet& net = fold.design.folded;
  metrics["fold_deg"] = in_degrees(net.error.fold);
  metrics["fold_miss_deg"] = to_degrees(largest_miss(net.net, net.error));
  metrics["face_rms"] = net.error.rms;
  metrics["met"] = fold.met();
  if (!fold.physics) return;
  metrics["fold_physics_deg"] = in_degrees(fold.physics->fold);
  metrics["fold_miss_physics_deg"] = to_degrees(largest_miss(net.net, *fold.physics));
  metrics["face_rms_physics"] = fold.physics->rms;
}

std::vector<std::array<std::string, 2>> fold_lines(const Run& run) {
  const FoldOutcome& fold = *run.fold;
  const FoldedNet& net = fold.design.folded;
  std::vector<std::array<std::string, 2>> lines;
  lines.push_back({"solid", in_words(net.net, net.error) + (fold.met() ? "" : ": DOES NOT FOLD AS ASKED")});
  for (const std::string& why : fold.why_missed) lines.push_back({"why", why});
  lines.push_back(
      {"net", fmt::format("{} faces, {} a crease, unfolding {} of {}", net.net.faces.size(),
                          columns_in_words(net.layout), fold.design.net + 1, fold.goal.nets.size())});
  lines.push_back({"search", fmt::format("{:.3f} s, {} motions looked at", run.timings.optimise,
                                         fold.design.evaluations)});
  if (fold.physics) lines.push_back({"folded", "in the physics run: " + in_words(net.net, *fold.physics)});
  for (const std::string& why : fold.why_physics) lines.push_back({"why", why});
  return lines;
}

}  // namespace kinetix
