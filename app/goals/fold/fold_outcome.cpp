#include "app/goals/fold/fold_outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "app/run/run.hpp"
#include "optim/fold/fit_box.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

Json faces_json(const FoldOutcome& fold, const Run& run) {
  const auto& error = measure_of<FoldMeasure>(run).error;
  const auto* physics = physics_measure_of<FoldMeasure>(run);
  const optim::FoldedNet& net = fold.design.folded;
  Json faces = Json::array();
  for (std::size_t f = 0; f < net.net.faces.size(); ++f) {
    const model::CellRectangle& placed = net.layout.faces[f];
    faces.push_back({{"name", net.net.faces[f].name},
                     {"cell", label(placed.low)},
                     {"cells", {placed.width, placed.height}},
                     {"rms", error.face_rms[f]}});
    if (physics) faces.back()["rms_physics"] = physics->error.face_rms[f];
  }
  return faces;
}

Json crease_json(const FoldOutcome& fold, const Run& run, std::size_t c) {
  const auto& shape = measure_of<FoldMeasure>(run);
  const optim::FoldedNet& net = fold.design.folded;
  const targets::PlacedCrease& placed = net.layout.creases[c];
  Json out = {{"name", crease_name(net.net, net.net.creases[c])},
              {"faces", {net.net.creases[c].first, net.net.creases[c].second}},
              {"axis", placed.axis == model::Axis::x ? "x" : "y"},
              {"cell", label(placed.cells.low)},
              {"cells", {placed.cells.width, placed.cells.height}},
              {"columns", placed.columns()},
              {"angle_deg", to_degrees(net.net.creases[c].angle)},
              {"fold_deg", to_degrees(shape.error.fold[c])},
              {"tilt_deg", to_degrees(shape.tilt[c])}};
  if (const auto* physics = physics_measure_of<FoldMeasure>(run))
    out["fold_physics_deg"] = to_degrees(physics->error.fold[c]);
  return out;
}

Json attempts_json(const optim::FoldDesign& design) {
  Json out = Json::array();
  for (const optim::FoldAttempt& attempt : design.attempts)
    out.push_back({{"unfolding", attempt.net}, {"columns", attempt.columns}, {"why", attempt.why}});
  return out;
}

/// "2 columns", or "1 to 4 columns"
std::string columns_in_words(const targets::NetLayout& layout) {
  int least = targets::max_crease_columns, most = 0;
  for (const targets::PlacedCrease& crease : layout.creases) {
    least = std::min(least, crease.columns());
    most = std::max(most, crease.columns());
  }
  if (least >= most) return fmt::format("{} {}", most, most == 1 ? "column" : "columns");
  return fmt::format("{} to {} columns", least, most);
}

std::string size_text(const FoldOutcome& fold) {
  const auto mm = fold.edges_mm();
  std::string text = fmt::format("{:.1f} x {:.1f} x {:.1f} mm when it is {}", mm[0], mm[1], mm[2],
                                 fold.goal.open ? "folded" : "closed");
  const auto& asked = fold.goal.box_mm;
  if (asked)
    text += fmt::format(", of {:g} x {:g} x {:g} mm: {:.1f} % off at most", (*asked)[0], (*asked)[1],
                        (*asked)[2], 100 * optim::size_miss(mm, *asked));
  return text;
}

Json creases_json(const FoldOutcome& fold, const Run& run) {
  Json out = Json::array();
  for (std::size_t c = 0; c < fold.design.folded.net.creases.size(); ++c)
    out.push_back(crease_json(fold, run, c));
  return out;
}

Json loads_json(const FoldLoads& loads) {
  return {{"theta_rad", loads.theta}, {"force_N", loads.hinges.force_N}, {"strain", loads.hinges.strain}};
}

std::string loads_text(const FoldLoads& loads) {
  return fmt::format("at theta {:.1f} deg: {:.3g} N{}, strain {:.2f}", to_degrees(loads.theta),
                     loads.hinges.force_N, lever_words(loads.hinges), loads.hinges.strain);
}

Json fold_json(const FoldOutcome& fold, const Run& run) {
  Json out = {{"faces", faces_json(fold, run)},
              {"creases", creases_json(fold, run)},
              {"unfoldings", fold.goal.nets.size()},
              {"unfolding", fold.design.net},
              {"attempts", attempts_json(fold.design)},
              {"reasons", run.violations},
              {"reasons_physics", run.physics_violations()}};
  if (fold.goal.box) out["edges_mm"] = fold.edges_mm();
  if (const auto& loads = measure_of<FoldMeasure>(run).loads) out["loads"] = loads_json(*loads);
  if (fold.unlimited) out["unlimited"] = loads_json(*fold.unlimited);
  return out;
}

/// The faces of the ideal solid where the folded state has them: a closed line of four corners each.
Json ideal_json(const FoldOutcome& fold, const model::State& state) {
  const optim::FoldedNet& net = fold.design.folded;
  std::map<int, Eigen::Vector3d> places;
  for (const targets::IdealPoint& one : ideal_vertices(net.net, net.layout, net.structure, state, net.theta))
    places[one.body] = one.place;
  Json out = Json::array();
  for (const model::CellRectangle& face : net.layout.faces) {
    Json line = Json::array();
    for (const auto& [i, j] :
         {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1), std::pair(0, 0)}) {
      const auto body = net.structure.body_at({face.low.i + i * face.width, face.low.j + j * face.height});
      const Eigen::Vector3d& p = places.at(*body);
      line.push_back({p.x(), p.y(), p.z()});
    }
    out.push_back(std::move(line));
  }
  return out;
}

}  // namespace

std::array<double, 3> FoldOutcome::edges_mm() const {
  const optim::FoldedNet& net = design.folded;
  return optim::folded_box(*goal.box, goal.open, net.structure.size.edge_mm, net.theta,
                           net.layout.creases[0].columns());
}

std::vector<FoldedCrease> FoldOutcome::creases(const targets::FoldError& error) const {
  const targets::FoldNet& net = design.folded.net;
  return folded_creases(net.creases, error.fold,
                        [&](const targets::FoldCrease& crease) { return crease_name(net, crease); });
}

void FoldOutcome::add_sections(const Run& run, Json& result) const {
  const targets::FoldNet& net = design.folded.net;
  Json out = {{"kind", "fold"}};
  if (goal.box) out["box"] = *goal.box;
  if (goal.box_mm) out["box_mm"] = *goal.box_mm;
  if (goal.open) out["open"] = targets::box_face_names()[*goal.open];
  out["faces"] = Json::array();
  for (const targets::FoldFace& face : net.faces)
    out["faces"].push_back({{"name", face.name}, {"cells", {face.width, face.height}}});
  out["creases"] = Json::array();
  for (const targets::FoldCrease& crease : net.creases)
    out["creases"].push_back({{"faces", {net.faces[crease.first].name, net.faces[crease.second].name}},
                              {"side", to_string(crease.side)},
                              {"angle_deg", to_degrees(crease.angle)},
                              {"shift", crease.shift}});
  result["target"] = out;
  result["fold"] = fold_json(*this, run);
  if (design.folds && !run.states.empty() && is_finite(run.states.front().poses))
    result["fold"]["ideal_mm"] = ideal_json(*this, run.states.front().poses);
  result["optimiser"] =
      closed_form_json(design.attempts.size(), design.evaluations, design.stopped, design.folds,
                       "no unfolding and no number of columns tried folds freely");
}

void FoldOutcome::add_metrics(const Run& run, Json& metrics) const {
  const targets::FoldError& error = measure_of<FoldMeasure>(run).error;
  add_fold_metrics(creases(error), error.rms, "", metrics);
  metrics["met"] = run.met();
  if (const auto* physics = physics_measure_of<FoldMeasure>(run))
    add_fold_metrics(creases(physics->error), physics->error.rms, "_physics", metrics);
}

std::vector<SummaryLine> FoldOutcome::summary_lines(const Run& run) const {
  const optim::FoldedNet& net = design.folded;
  const targets::FoldError& error = measure_of<FoldMeasure>(run).error;
  const std::optional<FoldLoads>& borne = measure_of<FoldMeasure>(run).loads;
  std::vector<SummaryLine> lines;
  lines.push_back(
      {"solid", in_words(creases(error), error.rms) + (run.met() ? "" : ": DOES NOT FOLD AS REQUIRED")});
  lines.push_back({"net", fmt::format("{} face{}, {} per crease, unfolding {} of {}", net.net.faces.size(),
                                      net.net.faces.size() == 1 ? "" : "s", columns_in_words(net.layout),
                                      design.net + 1, goal.nets.size())});
  if (goal.box) lines.push_back({"size", size_text(*this)});
  lines.push_back(
      {"search", fmt::format("{:.3f} s, {} motions examined", run.timings.optimise, design.evaluations)});
  if (borne) lines.push_back({"limits", loads_text(*borne)});
  if (unlimited) lines.push_back({"", "without them " + loads_text(*unlimited)});
  if (const auto* physics = physics_measure_of<FoldMeasure>(run))
    lines.push_back(
        {"folded", "in the physics run: " + in_words(creases(physics->error), physics->error.rms)});
  return lines;
}

}  // namespace kinetix::app
