#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/assembly/assembly_run.hpp"
#include "app/result/physics_json.hpp"
#include "app/result/state_json.hpp"
#include "app/version.hpp"
#include "model/base/angle.hpp"

namespace kinetix::app {
namespace {

using ResultJson = nlohmann::ordered_json;

ResultJson vector_json3(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

ResultJson hinge_of_json(const model::AssemblyHinge& h) {
  ResultJson out = {
      {"name", h.name},
      {"bodies", {h.lower, h.upper}},
      {"point_mm", vector_json3(h.point)},
      {"axis", vector_json3(h.axis)},
      {"reach_mm", h.reach_mm},
      {"k", {{"axial", h.k.axial}, {"shear", h.k.shear}, {"along", h.k.along}, {"turn", h.k.turn}}}};
  if (h.k.rock) out["k"]["rock"] = *h.k.rock;
  if (h.k.twist) out["k"]["twist"] = *h.k.twist;
  if (h.ball) out["ball"] = true;
  return out;
}

ResultJson bodies_and_hinges(const model::Assembly& a) {
  ResultJson bodies = ResultJson::array(), hinges = ResultJson::array();
  for (const model::AssemblyBody& b : a.bodies)
    bodies.push_back({{"name", b.name}, {"position_mm", vector_json3(b.position)}});
  for (const model::AssemblyHinge& h : a.hinges) hinges.push_back(hinge_of_json(h));
  return {{"cell_mm", a.edge_mm}, {"bodies", bodies}, {"hinges", hinges}, {"cells", ResultJson::array()}};
}

std::string pull_words(const model::Deployment& d, double seconds) {
  if (!d.reached)
    return fmt::format(
        "bodies follow their pull for {:.0f} % of the way and no further: hinges would have to open",
        100 * d.shares.back());
  return fmt::format(
      "bodies end {:.2g} cell edges from where they are pulled to, rms, at most {:.2g}; hinges stay closed "
      "within {:.1e} cell "
      "edges; {} states in {:.2f} s",
      d.off_rms, d.off_max, d.gap, d.states.size(), seconds);
}

ResultJson states_json(const AssemblyRun& run) {
  ResultJson out = ResultJson::array();
  for (const NamedState& s : run.states)
    out.push_back({{"name", s.name},
                   {"model", s.model},
                   {"theta_rad", s.theta},
                   {"poses", poses_json(s.poses)},
                   {"hinge_gap_max", s.gaps.max},
                   {"hinge_gap_rms", s.gaps.rms}});
  return out;
}

ResultJson numbers_of(const AssemblyRun& run) {
  ResultJson out = {{"theta_rad", run.theta}};
  if (const auto& d = run.deployment) {
    out["pull_rms"] = d->off_rms;
    out["pull_max"] = d->off_max;
  }
  if (run.equilibrium) {
    out["load"] = run.equilibrium->steps.back().load;
    out["energy_Nmm"] = run.equilibrium->steps.back().energy;
    out["contacts"] = run.equilibrium->steps.back().contacts;
  }
  if (const auto& v = run.verification) {
    out["verify_rms"] = v->distance.rms;
    out["verify_max"] = v->distance.max;
    out["hinge_gap_max"] = v->physics.gaps.max;
    out["hinge_axis_max_rad"] = v->physics.gaps.axis_max;
    out["verified"] = v->agrees;
  }
  return out;
}

ResultJson tolerance_of(const AssemblyRun& run) {
  ResultJson out = {{"verify", GoalSettings::usual_verify}};
  if (run.file.poses) out["pull"] = run.file.pull_tolerance;
  return out;
}

ResultJson speeds(const AssemblyRun& run) {
  ResultJson out = ResultJson::array();
  out.push_back({{"model", "exact"},
                 {"seconds", run.closure_s},
                 {"error", run.motion.gap},
                 {"against", "its own hinge closure"}});
  if (const auto& v = run.verification; v && v->compared)
    out.push_back({{"model", "bullet"},
                   {"seconds", v->physics.seconds},
                   {"error", v->distance.rms},
                   {"against", "exact"}});
  return out;
}

}  // namespace

std::string closure_words(const AssemblyRun& run) {
  const auto& hinges = run.file.assembly.hinges;
  const model::AssemblyMotion& m = run.motion;
  if (const auto& d = run.deployment) return pull_words(*d, run.closure_s);
  if (m.reached)
    return fmt::format(
        "`{}` turned by {:.2f} deg; hinges stay closed within {:.1e} cell edges and {:.1e} rad",
        hinges[run.driven].name, to_degrees(m.turns.back()), m.gap, m.axis_gap);
  if (m.broken < 0)
    return fmt::format("stopped with `{}` turned by {:.2f} deg", hinges[run.driven].name,
                       to_degrees(m.turns.back()));
  return fmt::format("`{}` turns by {:.2f} deg and no further: at {:.2f} deg `{}` opens by more than it may",
                     hinges[run.driven].name, to_degrees(m.turns.back()), to_degrees(m.broken_turn),
                     hinges[m.broken].name);
}

nlohmann::ordered_json assembly_structure(const model::Assembly& assembly) {
  return bodies_and_hinges(assembly);
}

nlohmann::ordered_json assembly_result(const AssemblyRun& run) {
  const model::Assembly& a = run.file.assembly;
  ResultJson out = {{"schema", "kinetix-result/1"},
                    {"name", run.file.name},
                    {"kinetix_version", version},
                    {"seed", 0},
                    {"target", nullptr},
                    {"verdict", verdict_json(verdict_of(run))},
                    {"plan",
                     {{"family", "none"},
                      {"model", to_string(run.model)},
                      {"bodies", a.bodies.size()},
                      {"hinges", a.hinges.size()},
                      {"why", {closure_words(run)}}}},
                    {"structure", bodies_and_hinges(a)},
                    {"states", states_json(run)},
                    {"metrics", numbers_of(run)},
                    {"tolerance", tolerance_of(run)},
                    {"fidelity", speeds(run)},
                    {"timing_s",
                     {{"load", run.load_s},
                      {"plan", 0.0},
                      {"optimise", 0.0},
                      {"verify", run.verification ? run.verification->physics.seconds : 0.0},
                      {"write", 0.0}}}};
  if (run.verification) out["physics"] = physics_json(*run.verification);
  return out;
}

std::string assembly_summary(const AssemblyRun& run) {
  const RunVerdict verdict = verdict_of(run);
  std::string out = fmt::format("{}: {}\n", run.file.name, headline(verdict));
  const auto line = [&](const std::string& label, const std::string& text) {
    out += fmt::format("  {:<10} {}\n", label, text);
  };
  for (const auto& [label, words] : problem_lines(verdict)) line(label, words);
  line("bodies",
       fmt::format("{}, {} hinges", run.file.assembly.bodies.size(), run.file.assembly.hinges.size()));
  line(run.deployment ? "pull" : "closure", closure_words(run));
  if (const auto& e = run.equilibrium) {
    line("load", fmt::format("moment {:.4g} N mm: {}", e->steps.back().load, e->why));
    line("energy", fmt::format("{:.4g} N mm", e->steps.back().energy));
    line("stretch", fmt::format("largest {:.2e} cell edges", e->gaps.max));
    for (const model::PathEvent& event : e->events)
      line("event", fmt::format("{} at {:.2f} deg: {}", to_string(event.kind), to_degrees(event.at.drive),
                                event.what));
  }
  if (const auto& v = run.verification) {
    if (v->physics.status != sim::PhysicsResult::Status::settled)
      line("physics", fmt::format("FAILED, {}: {}", to_string(v->physics.status), v->physics.why));
    else if (!v->compared)
      line("physics",
           fmt::format("settled in {:.2f} s; no closed state to compare with", v->physics.seconds));
    else
      line("physics",
           fmt::format("rms {:.1e} cell edges from the closed state, hinge gap {:.1e}, {:.2f} s: {}",
                       v->distance.rms, v->physics.gaps.max, v->physics.seconds,
                       v->agrees ? "agrees" : "DISAGREES"));
  }
  if (run.pieces)
    line("contact", fmt::format("{} convex pieces of the bodies, made in {:.2f} s", run.pieces->count(),
                                run.pieces->seconds));
  return out;
}

}  // namespace kinetix::app
