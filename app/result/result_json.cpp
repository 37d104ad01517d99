#include "app/result/result_json.hpp"

#include <fmt/format.h>

#include "app/console/short_form.hpp"
#include "app/result/motion_evidence.hpp"
#include "app/result/print_evidence.hpp"
#include "app/result/state_json.hpp"
#include "app/result/summary.hpp"
#include "app/result/verdict.hpp"
#include "app/run/design_hinges.hpp"
#include "app/version.hpp"
#include "model/closure/drive_theta.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

std::string words(const RobustCandidate& one) {
  std::string text = fmt::format("fold angle {:.1f} deg", one.theta / radians_per_degree);
  if (one.gap_mm) text += fmt::format(" and gaps of {:.2g} mm", *one.gap_mm);
  return text + ", " +
         (std::isfinite(one.printed_mm) ? "print error " + format_figures(one.printed_mm) + " mm"
                                        : "print error unknown") +
         (one.is_allowed ? "" : " (rejected: " + one.why_not + ")");
}

}  // namespace

nlohmann::ordered_json search_json(const optim::MultiStartResult& search, int chosen,
                                   optim::SolverName solver) {
  auto runs = nlohmann::ordered_json::array();
  int evaluations = 0;
  for (std::size_t k = 0; k < search.runs.size(); ++k) {
    const optim::SolveResult& run = search.runs[k];
    evaluations += run.evaluations;
    runs.push_back({{"start", k},
                    {"status", to_string(run.status)},
                    {"fit_rms", run.residual_norm},
                    {"evaluations", run.evaluations},
                    {"history", run.history}});
  }
  const optim::SolveResult& best = search.runs[chosen];
  return {{"solver", to_string(solver)},
          {"starts", runs.size()},
          {"evaluations", evaluations},
          {"status", to_string(best.status)},
          {"why", best.why},
          {"best_start", chosen},
          {"runs", runs}};
}

SummaryLine search_line(double seconds, const optim::MultiStartResult& search, int chosen,
                        optim::SolverName solver) {
  return {"search", fmt::format("{} s, {}, {} starts, {}", format_figures(seconds), to_string(solver),
                                search.runs.size(), to_string(search.runs[chosen].status))};
}

SummaryLine describe_shape(double rms, double most, double diagonal_mm, double limit) {
  return {"shape", fmt::format("{} mm rms from the curve, {} mm at most; limit {} mm rms",
                               format_figures(rms * diagonal_mm), format_figures(most * diagonal_mm),
                               format_figures(limit * diagonal_mm))};
}

nlohmann::ordered_json search_json(const optim::SolveResult& search, int starts) {
  return {{"solver", "ceres"},
          {"starts", starts},
          {"evaluations", search.evaluations},
          {"status", to_string(search.status)},
          {"why", search.why}};
}

SummaryLine search_line(double seconds, const optim::SolveResult& search) {
  return {"search", fmt::format("{} s, ceres, {} evaluations, {}", format_figures(seconds),
                                search.evaluations, to_string(search.status))};
}

double tolerance_of(const Run& run, std::string_view key) {
  const auto found = std::find_if(run.tolerances.begin(), run.tolerances.end(),
                                  [&](const auto& limit) { return limit.first == key; });
  return found == run.tolerances.end() ? std::nan("") : found->second;
}

void add_end(bool stopped, bool found, const std::string& why, const std::string& why_not,
             nlohmann::ordered_json& optimiser) {
  const char* const ended = found ? "converged" : "failed";
  optimiser["status"] = stopped ? "stopped" : ended;
  optimiser["why"] = stopped ? "stopped" : found ? why : why_not;
}

Json robust_json(const Run& run) {
  Json out = Json::array();
  for (std::size_t k = 0; k < run.robust->tried.size(); ++k) {
    const RobustCandidate& one = run.robust->tried[k];
    out.push_back({{"theta_rad", one.theta},
                   {"cell_mm", one.cell_mm},
                   {"gap_mm", one.gap_mm ? Json(*one.gap_mm) : Json(nullptr)},
                   {"designed_mm", one.designed_mm},
                   {"as_made_rms_mm", one.printed_mm},
                   {"as_made_p95_mm", one.printed_p95_mm},
                   {"allowed", one.is_allowed},
                   {"chosen", k == run.robust->chosen}});
    if (!one.is_allowed) out.back()["why_not"] = one.why_not;
  }
  return out;
}

std::vector<SummaryLine> robust_lines(const Run& run) {
  if (!run.robust) return {};
  const RobustCandidate &best = run.robust->tried[run.robust->chosen], &plain = run.robust->tried.front();
  if (run.robust->chosen == 0)
    return {{"robust", fmt::format("tried {} designs; none is expected to print more accurately than the "
                                   "original{}",
                                   run.robust->tried.size(), plain.is_allowed ? "" : ", " + words(plain))}};
  return {{"robust", fmt::format("tried {} designs; most accurate prints: {}; original: {}",
                                 run.robust->tried.size(), words(best), words(plain))}};
}

namespace {

/// Adds stable_states, energy_barriers and unresolved_releases to the section `equilibrium` of result.json.
/// @pre run.equilibrium
void add_stable_states(const Run& run, Json& equilibrium) {
  const model::StableStates& stable = run.equilibrium->stable;
  const model::Linkage structure = run.design.structure;
  Json states = Json::array(), barriers = Json::array();
  for (const model::StableState& s : stable.states)
    states.push_back({{"theta_rad", s.theta},
                      {"drive", coordinate_of(run.equilibrium->drive, structure, s.state)},
                      {"energy_Nmm", s.energy},
                      {"hinge_gap_max", s.gaps.max},
                      {"how", s.how},
                      {"poses", poses_json(s.state)}});
  for (const model::EnergyBarrier& b : stable.barriers)
    barriers.push_back({{"between", {b.from, b.to}},
                        {"energy_Nmm", b.energy},
                        {"theta_rad", b.theta},
                        {"drive", b.drive},
                        {"balanced", b.load_vanishes}});
  equilibrium["stable_states"] = states;
  equilibrium["energy_barriers"] = barriers;
  equilibrium["unresolved_releases"] = stable.unresolved;
}

Json comparison_json(const model::EquilibriumComparison& c) {
  return {{"outcome", to_string(c.outcome)}, {"why", c.why},
          {"rms", c.distance.rms},           {"rms_from_balance", c.from_equilibrium.rms},
          {"energy_Nmm", c.energy},          {"model_energy_Nmm", c.reference_energy}};
}

/// Returns the section `physics` of result.json.
Json physics_json(const Verification& v) {
  Json out = {{"status", to_string(v.physics.status)},
              {"why", v.physics.why},
              {"steps", v.physics.steps},
              {"simulated_s", v.physics.simulated_s},
              {"seconds", v.physics.seconds},
              {"unrest", v.physics.residual_motion},
              {"options",
               {{"step_s", v.options.step_s},
                {"reach", v.options.reach},
                {"contact", v.options.contact},
                {"elastic", v.options.elastic.has_value()},
                {"planar", v.options.planar}}}};
  if (v.equilibrium) out["comparison"] = comparison_json(*v.equilibrium);
  return out;
}

Json plan_json(const Run& run) {
  const Plan& plan = run.plan;
  Json out = {{"family", plan.exact.name},
              {"model", to_string(plan.model)},
              {"bodies", run.design.structure.bodies()},
              {"hinges", run.design.structure.hinges()},
              {"why", plan.why}};
  if (const auto& m = plan.mobility)
    out["mobility"] = {{"verdict", to_string(m->verdict)},
                       {"flat", m->dofs_flat},
                       {"moving", m->dofs_along},
                       {"gruebler", m->gruebler_spatial}};
  return out;
}

double reach_of(const Design& design, int index, double usual_mm, const model::Elasticity* elasticity) {
  if (elasticity) return elasticity->of(index).reach_mm;
  const HingeSection& hinge = hinge_section(design, index);
  return hinge.made ? model::reach_mm(*hinge.made) : hinge.reach_mm.value_or(usual_mm);
}

Json hinge_json(const Design& design, int index, double usual_reach_mm, const model::Elasticity* elasticity) {
  const model::Lattice& s = design.structure;
  const model::HingedWall wall = s.wall(index);
  const model::RestHinge hinge = rest_hinge(s, index);
  const double edge_mm = s.size().edge_mm;
  Json out = {{"bodies", {wall.lower, wall.upper}},
              {"t", wall.hinge.t},
              {"alpha_rad", wall.hinge.alpha},
              {"beta_rad", wall.hinge.beta},
              {"offset_mm", wall.hinge.offset * edge_mm},
              {"point_mm", point_json(s.rest_position(wall.lower) + edge_mm * hinge.lower_arm)},
              {"axis", point_json(hinge.axis)},
              {"reach_mm", reach_of(design, index, usual_reach_mm, elasticity)}};
  if (design.hinge.model == HingeSection::Model::rotary) return out;  // a joint
  if (const auto k = framed_stiffness(hinge_section(design, index))) out["k"] = stiffness_json(*k);
  return out;
}

Json state_json(const NamedState& state) {
  return {{"name", state.name},
          {"model", state.model},
          {"theta_rad", state.theta},
          {"poses", poses_json(state.poses)},
          {"hinge_gap_max", state.gaps.max},
          {"hinge_gap_rms", state.gaps.rms}};
}

/// Returns the section `tolerance`. Designs have no goal, so theirs only has `verify`.
Json tolerance_json(const Run& run) {
  Json out = Json::object();
  for (const auto& [key, limit] : run.tolerances) out[key] = limit;
  out["verify"] = run.verify_tolerance;
  return out;
}

Json fidelity_json(const std::vector<Fidelity>& rows) {
  Json out = Json::array();
  for (const Fidelity& row : rows)
    out.push_back(
        {{"model", row.model}, {"seconds", row.seconds}, {"error", row.error}, {"against", row.against}});
  return out;
}

}  // namespace

Json structure_json(const Design& design, double reach_mm, const model::Elasticity* elasticity) {
  const model::Lattice& s = design.structure;
  if (const model::Assembly* imported = s.assembly()) return bodies_json(*imported);
  Json bodies = Json::array(), hinges = Json::array(), cells = Json::array();
  for (int b = 0; b < s.bodies(); ++b)
    bodies.push_back({{"vertex", body_label(s, b)}, {"position_mm", point_json(s.rest_position(b))}});
  for (int h = 0; h < s.hinges(); ++h) hinges.push_back(hinge_json(design, h, reach_mm, elasticity));
  for (int c = 0; c < s.cells(); ++c)
    cells.push_back({{"cell", cell_label(s, c)}, {"bodies", s.cell_bodies(c)}, {"hinges", s.cell_hinges(c)}});
  return {{"lattice", lattice_name(s)},
          {"cell_mm", s.size().edge_mm},
          {"wall_mm", {{"thickness", s.size().thickness_mm}, {"height", s.size().height_mm}}},
          {"bodies", bodies},
          {"hinges", hinges},
          {"cells", cells}};
}

Json metrics_json(const Run& run) {
  Json metrics = {{"theta_rad", run.theta}};
  if (run.plan.free_range) {
    const model::ContactLimit& limit = run.plan.free_range->to(run.theta);
    if (limit.touches) metrics["theta_limit_rad"] = limit.theta;
  }
  if (run.closed_path && run.closed_path->off) {
    metrics["pull_rms"] = run.closed_path->off->rms;
    metrics["pull_max"] = run.closed_path->off->max;
  }
  if (run.goal) run.goal->add_metrics(run, metrics);
  if (run.closed_path && run.equilibrium) {
    metrics["load"] = run.equilibrium->path.steps.back().load;
    metrics["contacts"] = run.equilibrium->path.steps.back().contacts;
  }
  if (run.equilibrium) add_equilibrium_metrics(*run.equilibrium, metrics);
  if (run.equilibrium)
    metrics["stretch_max_mm"] = run.equilibrium->path.gaps.max * run.design.structure.size().edge_mm;
  if (run.printed) {
    metrics["as_made_rms_mm"] = run.printed->rms_mm();
    metrics["as_made_p95_mm"] = run.printed->p95_mm();
  }
  if (const auto worst = worst_strain(run)) {
    metrics["strain_max"] = worst->strain;
    metrics["strain_allowed"] = worst->allowed;
  }
  if (run.verification) {
    metrics["verify_rms"] = run.verification->distance.rms;
    metrics["verify_max"] = run.verification->distance.max;
    metrics["hinge_gap_max"] = run.verification->physics.gaps.max;
    metrics["hinge_gap_rms"] = run.verification->physics.gaps.rms;
    metrics["hinge_axis_max_rad"] = run.verification->physics.gaps.axis_max;
    metrics["verified"] = run.verification->agrees;
  }
  return metrics;
}

Json result_json(const Run& run) {
  const double edge = run.design.structure.size().edge_mm;
  const double reach = run.equilibrium    ? run.equilibrium->elasticity.reach_mm
                       : run.verification ? run.verification->options.reach * edge
                                          : sim::PhysicsOptions{}.reach * edge;
  const model::Elasticity* const elasticity = run.equilibrium ? &run.equilibrium->elasticity : nullptr;
  Json states = Json::array();
  for (const NamedState& state : run.states) states.push_back(state_json(state));
  Json out = {{"schema", "kinetix-result/1"},
              {"name", run.design.name},
              {"kinetix_version", version},
              {"seed", run.seed},
              {"target", nullptr},
              {"verdict", verdict_json(verdict_of(run))},
              {"summary", short_json(short_form(run))},
              {"plan", plan_json(run)},
              {"structure", structure_json(run.design, reach, elasticity)},
              {"states", states},
              {"metrics", metrics_json(run)},
              {"tolerance", tolerance_json(run)},
              {"fidelity", fidelity_json(run.fidelity)},
              {"timing_s",
               {{"load", run.timings.load},
                {"plan", run.timings.plan},
                {"optimise", run.timings.optimise},
                {"verify", run.timings.verify},
                {"write", 0.0}}}};
  if (run.goal) run.goal->add_sections(run, out);
  if (run.equilibrium) {
    out["equilibrium"] = equilibrium_json(*run.equilibrium);
    out["equilibrium"]["other_side"] = run.equilibrium->is_on_the_other_side(run.theta);
    add_stable_states(run, out["equilibrium"]);
    out["timing_s"]["balance"] = run.timings.equilibrium;
  }
  if (run.compensation) {
    out["matter"] = compensation_json(*run.compensation);
    out["timing_s"]["matter"] = run.timings.compensation;
  }
  if (run.certified) {
    out["certified"] =
        certified_json(*run.certified, run.design.structure, run.theta, closed_form_relation(run));
    out["timing_s"]["certify"] = run.timings.certify;
  }
  if (run.robust) out["robust"] = robust_json(run);
  if (run.printed) {
    out["as_made"] = print_tolerance_json(run);
    out["timing_s"]["as_made"] = run.timings.print_tolerance;
  }
  if (const auto& made = run.design.hinge.made; made && run.goal)
    out["manufacture"] =
        manufacture_json(run.design, *made, run.folding, run.print ? run.print->lock : std::nullopt);
  if (run.goal && !run.prints_unknown.empty()) out["as_made_unknown"] = run.prints_unknown;
  if (auto problems = hinge_problems_json(run); !problems.empty()) out["made_problems"] = std::move(problems);
  if (run.stopped) out["stopped"] = true;
  if (run.verification) out["physics"] = physics_json(*run.verification);
  return out;
}

}  // namespace kinetix::app
