#include "app/result_json.hpp"

#include <fmt/format.h>

#include "app/display_json.hpp"
#include "app/equilibrium_json.hpp"
#include "app/fold_json.hpp"
#include "app/helmet_json.hpp"
#include "app/physics_json.hpp"
#include "app/stable_states_json.hpp"
#include "app/state_json.hpp"
#include "app/version.hpp"

namespace kinetix {
namespace {

using Json = nlohmann::ordered_json;

Json numbers(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json points(const std::vector<Eigen::Vector2d>& polyline) {
  Json out = Json::array();
  for (const auto& p : polyline) out.push_back({p.x(), p.y()});
  return out;
}

Json target_json(const Run& run) {
  if (run.display) return display_target_json(*run.display);
  if (run.fold) return fold_target_json(*run.fold);
  if (run.helmet) return helmet_target_json(*run.helmet);
  if (!run.curve) return nullptr;
  return {{"kind", "curve"}, {"points_mm", points(run.curve->target_mm)}};
}

Json plan_json(const Run& run) {
  const Plan& plan = run.plan;
  Json out = {{"family", to_string(plan.family.family)},
              {"model", to_string(plan.model)},
              {"bodies", run.structure.bodies.size()},
              {"hinges", run.structure.hinges.size()},
              {"why", plan.why}};
  if (const auto& m = plan.mobility)
    out["mobility"] = {{"verdict", to_string(m->verdict)},
                       {"flat", m->freedoms_flat},
                       {"moving", m->freedoms_along},
                       {"gruebler", m->gruebler_spatial}};
  return out;
}

Json structure_json(const Structure& s, double reach_mm) {
  Json bodies = Json::array(), hinges = Json::array(), cells = Json::array();
  for (std::size_t b = 0; b < s.bodies.size(); ++b)
    bodies.push_back({{"vertex", {s.bodies[b].i, s.bodies[b].j}},
                      {"position_mm", numbers(s.rest_position(static_cast<int>(b)))}});
  for (const Hinge& h : s.hinges)
    hinges.push_back({{"bodies", {h.lower, h.upper}},
                      {"t", h.parameters.t},
                      {"alpha_rad", h.parameters.alpha},
                      {"beta_rad", h.parameters.beta},
                      {"point_mm", numbers(s.hinge_point(h))},
                      {"axis", numbers(hinge_axis(h.wall.axis, h.parameters))},
                      {"reach_mm", reach_mm}});
  for (std::size_t c = 0; c < s.cells.size(); ++c)
    cells.push_back({{"cell", {s.cells[c].i, s.cells[c].j}},
                     {"bodies", s.cell_members[c].bodies},
                     {"hinges", s.cell_members[c].hinges}});
  return {{"cell_mm", s.size.edge_mm},
          {"wall_mm", {{"thickness", s.size.thickness_mm}, {"height", s.size.height_mm}}},
          {"bodies", bodies},
          {"hinges", hinges},
          {"cells", cells}};
}

Json state_json(const NamedState& state) {
  return {{"name", state.name},
          {"model", state.model},
          {"theta_rad", state.theta},
          {"poses", poses_json(state.poses)},
          {"hinge_gap_max", state.gaps.max},
          {"hinge_gap_rms", state.gaps.rms}};
}

Json curve_json(const CurveOutcome& curve) {
  const CurveDesign& found = curve.found;
  Json error = Json::array(), turn = Json::array();
  for (std::size_t k = 0; k < found.error.arc_mm.size(); ++k)
    error.push_back({found.error.arc_mm[k], found.error.distance_mm[k]});
  for (const ColumnTurn& t : found.reach.turns)
    turn.push_back({{"column", t.column},
                    {"arc_mm", t.arc_mm},
                    {"needed_deg", t.needed / radians_per_degree},
                    {"allowed_deg", std::abs(t.allowed) / radians_per_degree}});
  return {{"folded_mm", points(found.midline_mm)},
          {"goal_mm", points(found.error.goal_mm)},
          {"error", error},
          {"scale_mm", found.error.scale_mm},
          {"turn", turn},
          {"reasons", curve.why_missed}};
}

Json optimiser_json(const CurveOutcome& curve) {
  const CurveDesign& found = curve.found;
  Json runs = Json::array();
  int evaluations = 0;
  for (std::size_t k = 0; k < found.search.runs.size(); ++k) {
    const SolveResult& run = found.search.runs[k];
    evaluations += run.evaluations;
    runs.push_back({{"start", k},
                    {"status", to_string(run.status)},
                    {"fit_rms", run.residual_norm},
                    {"evaluations", run.evaluations},
                    {"history", run.history}});
  }
  const SolveResult& best = found.search.runs[found.chosen];
  return {{"solver", to_string(curve.solver.name)},
          {"starts", runs.size()},
          {"evaluations", evaluations},
          {"status", to_string(best.status)},
          {"why", best.why},
          {"best_start", found.chosen},
          {"runs", runs}};
}

Json fidelity_json(const std::vector<Fidelity>& rows) {
  Json out = Json::array();
  for (const Fidelity& row : rows)
    out.push_back(
        {{"model", row.model}, {"seconds", row.seconds}, {"error", row.error}, {"against", row.against}});
  return out;
}

}  // namespace

Json metrics_json(const Run& run) {
  Json metrics = {{"theta_rad", run.theta}};
  if (run.plan.free_range) {
    const ThetaLimit& limit = run.theta < 0 ? run.plan.free_range->negative : run.plan.free_range->positive;
    if (limit.touches) metrics["theta_limit_rad"] = limit.theta;
  }
  if (run.curve) {
    const CurveError& error = run.curve->found.error;
    metrics["shape_rms"] = error.rms;
    metrics["shape_max"] = error.max;
    metrics["met"] = run.curve->met;
  }
  if (run.display) add_display_metrics(*run.display, metrics);
  if (run.fold) add_fold_metrics(*run.fold, metrics);
  if (run.helmet) add_helmet_metrics(*run.helmet, metrics);
  if (run.equilibrium) add_equilibrium_metrics(*run.equilibrium, metrics);
  if (run.verification) {
    metrics["verify_rms"] = run.verification->distance.rms;
    metrics["verify_max"] = run.verification->distance.max;
    metrics["hinge_gap_max"] = run.verification->physics.gaps.max;
    metrics["hinge_axis_max_rad"] = run.verification->physics.gaps.axis_max;
    metrics["verified"] = run.verification->agrees;
  }
  return metrics;
}

Json result_json(const Run& run) {
  const double edge = run.structure.size.edge_mm;
  const double reach = run.equilibrium    ? run.equilibrium->elasticity.reach_mm
                       : run.verification ? run.verification->options.reach * edge
                                          : PhysicsOptions{}.reach * edge;
  Json states = Json::array();
  for (const NamedState& state : run.states) states.push_back(state_json(state));
  Json out = {{"schema", "kinetix-result/1"},
              {"name", run.name},
              {"kinetix_version", version},
              {"seed", run.seed},
              {"target", target_json(run)},
              {"plan", plan_json(run)},
              {"structure", structure_json(run.structure, reach)},
              {"states", states},
              {"metrics", metrics_json(run)},
              {"tolerance", {{"shape", run.shape_tolerance}, {"verify", run.verify_tolerance}}},
              {"fidelity", fidelity_json(run.fidelity)},
              {"timing_s",
               {{"load", run.timings.load},
                {"plan", run.timings.plan},
                {"optimise", run.timings.optimise},
                {"verify", run.timings.verify},
                {"write", run.timings.write}}}};
  if (run.curve) {
    out["curve"] = curve_json(*run.curve);
    out["optimiser"] = optimiser_json(*run.curve);
  }
  if (run.display) {
    out["display"] = display_json(run);
    out["timing_s"]["larger_panels"] = run.timings.larger_panels;
    out["optimiser"] = display_optimiser_json(*run.display);
  }
  if (run.fold) {
    out["fold"] = fold_json(run);
    out["optimiser"] = fold_optimiser_json(*run.fold);
  }
  if (run.helmet) {
    out["helmet"] = helmet_json(run);
    out["optimiser"] = helmet_optimiser_json(*run.helmet);
  }
  if (run.equilibrium) {
    out["equilibrium"] = equilibrium_json(*run.equilibrium);
    add_stable_states(run, out["equilibrium"]);
    out["timing_s"]["balance"] = run.timings.balance;
  }
  if (run.verification) out["physics"] = physics_json(*run.verification);
  return out;
}

}  // namespace kinetix
