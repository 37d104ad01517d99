#include "app/goals/fold/solid_outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "app/run/run.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

std::string face_name(int face) { return std::to_string(face + 1); }

Json places_json(const targets::SolidNet& net, const std::vector<int>& bodies) {
  Json out = Json::array();
  for (const int body : bodies)
    out.push_back({net.structure.graph.vertices[body].x(), net.structure.graph.vertices[body].y()});
  return out;
}

Json face_json(const SolidOutcome& found, const Run& run, std::size_t f) {
  const targets::SolidNet& net = found.design.net;
  std::vector<int> ends;
  for (const auto& side : net.faces[f].sides) ends.insert(ends.end(), {side.front(), side.back()});
  Json out = {{"name", face_name(static_cast<int>(f))},
              {"corners", places_json(net, ends)},
              {"rms", measure_of<SolidMeasure>(run).error.face_rms[f]}};
  if (const auto* physics = physics_measure_of<SolidMeasure>(run))
    out["rms_physics"] = physics->error.face_rms[f];
  return out;
}

Json crease_json(const SolidOutcome& found, const Run& run, std::size_t c) {
  const auto& shape = measure_of<SolidMeasure>(run);
  const targets::SolidNet& net = found.design.net;
  const targets::SolidCrease& crease = net.creases[c];
  const auto& edges = net.structure.graph.edges;
  const auto &near = crease.hinges.front(), &far = crease.hinges.back();
  const std::vector<int> corners = {edges[near.front()].from, edges[near.back()].from, edges[far.back()].to,
                                    edges[far.front()].to};
  Json out = {{"name", crease_name(crease)},           {"faces", {crease.first, crease.second}},
              {"corners", places_json(net, corners)},  {"columns", net.columns},
              {"angle_deg", to_degrees(crease.angle)}, {"fold_deg", to_degrees(shape.error.fold[c])},
              {"tilt_deg", to_degrees(shape.tilt[c])}};
  if (const auto* physics = physics_measure_of<SolidMeasure>(run))
    out["fold_physics_deg"] = to_degrees(physics->error.fold[c]);
  return out;
}

/// The corners of a face round it and back to the first, as bodies.
std::vector<int> round_face(const targets::SolidFace& face) {
  std::vector<int> corners;
  for (const std::vector<int>& side : face.sides)
    for (const int body : {side.front(), side.back()})
      if (corners.empty() || corners.back() != body) corners.push_back(body);
  if (corners.back() != corners.front()) corners.push_back(corners.front());
  return corners;
}

/// The faces of the ideal solid where the folded state has them, as closed lines.
Json ideal_faces_json(const optim::SolidDesign& design, const model::State& state) {
  std::map<int, Eigen::Vector3d> places;
  for (const auto& [body, place] : ideal_places(design.net, state, design.theta)) places[body] = place;
  Json out = Json::array();
  for (const targets::SolidFace& face : design.net.faces) {
    Json line = Json::array();
    for (const int body : round_face(face)) {
      const Eigen::Vector3d& p = places.at(body);
      line.push_back({p.x(), p.y(), p.z()});
    }
    out.push_back(std::move(line));
  }
  return out;
}

Json fold_json(const SolidOutcome& found, const Run& run) {
  Json out = {{"faces", Json::array()},
              {"creases", Json::array()},
              {"unfoldings", 1},
              {"unfolding", 0},
              {"attempts", Json::array()},
              {"reasons", run.violations},
              {"reasons_physics", run.physics_violations()}};
  for (std::size_t f = 0; f < found.design.net.faces.size(); ++f)
    out["faces"].push_back(face_json(found, run, f));
  for (std::size_t c = 0; c < found.design.net.creases.size(); ++c)
    out["creases"].push_back(crease_json(found, run, c));
  for (const optim::SolidAttempt& attempt : found.design.attempts)
    out["attempts"].push_back(
        {{"unfolding", 0}, {"columns", std::vector<int>{attempt.columns}}, {"why", attempt.why}});
  return out;
}

}  // namespace

std::string crease_name(const targets::SolidCrease& crease) {
  return face_name(crease.first) + "-" + face_name(crease.second);
}

double SolidOutcome::edge_mm() const {
  return design.net.edge * design.net.structure.size.edge_mm * std::cos(design.theta);
}

std::vector<FoldedCrease> SolidOutcome::creases(const targets::SolidError& error) const {
  return folded_creases(design.net.creases, error.fold, crease_name);
}

void SolidOutcome::add_sections(const Run& run, Json& result) const {
  Json out = {{"kind", "fold"}, {"solid", targets::solid_names()[goal.solid]}, {"cells", goal.cells}};
  out["faces"] = Json::array();
  for (std::size_t f = 0; f < design.net.faces.size(); ++f)
    out["faces"].push_back({{"name", face_name(static_cast<int>(f))}});
  out["creases"] = Json::array();
  for (const targets::SolidCrease& crease : design.net.creases)
    out["creases"].push_back({{"faces", {face_name(crease.first), face_name(crease.second)}},
                              {"angle_deg", to_degrees(crease.angle)}});
  result["target"] = out;
  result["fold"] = fold_json(*this, run);
  if (design.folds && !run.states.empty() && is_finite(run.states.front().poses))
    result["fold"]["ideal_mm"] = ideal_faces_json(design, run.states.front().poses);
  result["optimiser"] = closed_form_json(design.attempts.size(), design.evaluations, design.stopped,
                                         design.folds, "no number of columns tried folds freely");
}

void SolidOutcome::add_metrics(const Run& run, Json& metrics) const {
  const targets::SolidError& error = measure_of<SolidMeasure>(run).error;
  add_fold_metrics(creases(error), error.rms, "", metrics);
  metrics["met"] = run.met();
  if (const auto* physics = physics_measure_of<SolidMeasure>(run))
    add_fold_metrics(creases(physics->error), physics->error.rms, "_physics", metrics);
}

std::vector<SummaryLine> SolidOutcome::summary_lines(const Run& run) const {
  const targets::SolidError& error = measure_of<SolidMeasure>(run).error;
  std::vector<SummaryLine> lines;
  lines.push_back(
      {"solid", in_words(creases(error), error.rms) + (run.met() ? "" : ": DOES NOT FOLD AS REQUIRED")});
  lines.push_back(
      {"net", fmt::format("{} face{} of {} cells a side, {} {} per crease", design.net.faces.size(),
                          design.net.faces.size() == 1 ? "" : "s", 2 * goal.cells, design.net.columns,
                          design.net.columns == 1 ? "column" : "columns")});
  lines.push_back({"size", fmt::format("edges of {:.1f} mm when it is closed", edge_mm())});
  lines.push_back(
      {"search", fmt::format("{:.3f} s, {} motions examined", run.timings.optimise, design.evaluations)});
  if (const auto* physics = physics_measure_of<SolidMeasure>(run))
    lines.push_back(
        {"folded", "in the physics run: " + in_words(creases(physics->error), physics->error.rms)});
  return lines;
}

}  // namespace kinetix::app
