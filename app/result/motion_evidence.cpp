#include "app/result/motion_evidence.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/console/short_form.hpp"
#include "app/result/state_json.hpp"
#include "model/elastic/path/closed_form.hpp"

namespace kinetix::app {
namespace {

struct Limit {
  double most;
  const char* label;
};

// N: two fingers pinch with 40 to 100, a hand grips with 200 to 500, body weight on two arms gives 300 and more.
constexpr Limit forces[] = {{20, "fingers"}, {100, "a hand"}, {300, "both arms"}};
// N mm: fingers turn a knob with 500 to 1500, a hand opens a jar with 4000 to 6000.
constexpr Limit moments[] = {{500, "fingers"}, {3000, "a hand"}, {10000, "both arms"}};

template <std::size_t N>
std::string label(const Limit (&limits)[N], double value) {
  for (const Limit& limit : limits)
    if (std::abs(value) <= limit.most) return limit.label;
  return "a vice";
}

}  // namespace

std::string classify_force(double newtons) { return label(forces, newtons); }

std::string classify_moment(double newton_mm) { return label(moments, newton_mm); }

std::string classify_load(const Equilibrium& equilibrium) {
  if (!equilibrium.drive.is_external()) return "its own springs";
  const double load = largest_load(equilibrium.path);
  return equilibrium.drive.has_force() ? classify_force(load) : classify_moment(load);
}

std::string describe_effort_class(const std::string& effort) {
  return effort == "fingers" ? "light finger pressure" : effort;
}

std::string describe_folding(const Folding& folding) {
  if (!folding.is_possible()) return folding.why_not;
  if (folding.is_unaided) return "unaided: its springs fold it";
  if (folding.is_by_turns())
    return "by hand, " + folding.name +
           ": its pins turn freely, but the drives that were tried lead to another fold";
  const bool is_named = folding.is_force || folding.name.starts_with("hinge ");
  const std::string load =
      fmt::format("{:.3g} {}{}{}{}", folding.load, folding.is_force ? "N" : "N mm",
                  folding.turns_freely ? " of friction" : "", is_named ? "" : " about one hinge",
                  folding.turns_freely ? ", which is assumed" : "");
  const std::string name = is_named ? ": " + folding.name : "", effort = describe_effort(folding);
  if (effort == "no") return "it takes " + load + " to fold, more than a clamp gives" + name;
  return effort + " with " + load + name;
}

namespace {

using Json = nlohmann::ordered_json;

Json step_json(const model::EquilibriumStep& step, const model::LinkageDrive& drive) {
  return {{"theta_rad", step.theta},
          {"drive", step.drive},
          {"drive_unit", drive.coordinate_unit()},
          {"load", step.load},
          {"load_unit", drive.load_unit()},
          {"energy_Nmm", step.energy},
          {"gap", step.gap},
          {"contacts", step.contacts},
          {"stable", step.stable}};
}

Json event_json(const model::PathEvent& event) {
  return {{"kind", to_string(event.kind)}, {"theta_rad", event.at.theta}, {"since_rad", event.since},
          {"drive", event.at.drive},       {"load", event.at.load},       {"what", event.what}};
}

/// Adds the stiffness terms of hinges that are not just two springs k_point.
void add_directions(const model::Elasticity& e, Json& stiffness) {
  const model::HingeStiffness k = stiffness_of(e);
  if (!e.ratios.are_one() || !e.tilt.are_by_reach())
    stiffness.update({{"axial", k.axial}, {"shear", k.shear}, {"along", k.along}});
  if (k.rock) stiffness["rock"] = *k.rock;
  if (k.twist) stiffness["twist"] = *k.twist;
  if (e.play_mm > 0) stiffness["play_mm"] = e.play_mm;
}

std::string change_text(const CompensationResult& compensation) {
  return fmt::format("tilts changed by up to {:.2f} deg, fold angle by {:.2f} deg, in {} steps: {}",
                     to_degrees(compensation.largest_change), to_degrees(compensation.theta_change),
                     compensation.rounds, compensation.why);
}

}  // namespace

double mean_moment(const Equilibrium& equilibrium) {
  return equilibrium.path.steps.back().load / static_cast<double>(equilibrium.drive.springs.size());
}

Json equilibrium_json(const Equilibrium& equilibrium) {
  const model::EquilibriumPath& path = equilibrium.path;
  const model::Elasticity& e = equilibrium.elasticity;
  Json steps = Json::array(), events = Json::array(), energies = Json::array();
  Json stiffness = {
      {"k_point", e.k_point}, {"k_turn", e.k_turn}, {"reach_mm", e.reach_mm}, {"k_contact", e.k_contact}};
  if (e.each.empty()) add_directions(e, stiffness);
  for (const model::EquilibriumStep& step : path.steps) steps.push_back(step_json(step, equilibrium.drive));
  for (const model::PathEvent& event : path.events) events.push_back(event_json(event));
  for (const model::HingeEnergy& energy : path.hinge_energies)
    energies.push_back({{"stretch", energy.stretch}, {"turn", energy.turn}});
  Json json = {{"stop", to_string(path.stop)},
               {"why", path.why},
               {"effort", classify_load(equilibrium)},
               {"planar", path.planar},
               {"goal_rad", equilibrium.drive.theta()},
               {"iterations", path.iterations},
               {"stiffness", stiffness},
               {"path", steps},
               {"events", events},
               {"hinge_energy_Nmm", energies}};
  if (!equilibrium.drive.is_external())
    json["shape_memory"] = {{"springs", equilibrium.drive.springs.size()},
                            {"k_turn", equilibrium.drive.k_spring},
                            {"energy_Nmm", path.steps.back().springs},
                            {"moment_mean_Nmm", mean_moment(equilibrium)}};
  return json;
}

void add_equilibrium_metrics(const Equilibrium& equilibrium, Json& metrics) {
  const model::EquilibriumStep& last = equilibrium.path.steps.back();
  metrics["reached"] = equilibrium.reached();
  metrics[equilibrium.drive.coordinate_name()] = last.drive;
  metrics[equilibrium.drive.has_force() ? "load_N" : "load_Nmm"] = last.load;
  if (equilibrium.drive.has_force()) metrics["force_N"] = largest_load(equilibrium.path);
  metrics["energy_Nmm"] = last.energy;
  metrics["hinge_gap_max"] = equilibrium.path.gaps.max;
  metrics["hinge_gap_rms"] = equilibrium.path.gaps.rms;
  if (!equilibrium.from_exact) return;
  metrics["exact_rms"] = equilibrium.from_exact->rms;
  metrics["exact_max"] = equilibrium.from_exact->max;
}

namespace {

/// Formatter of a drive by the keys of a design.
struct DriveJson {
  const model::Lattice& structure;

  Json wall(int hinge) const { return Json::parse(wall_name(structure, hinge)); }

  Json operator()(const model::Plates& plates) const {
    return {{"kind", "plates"}, {"axis", to_string(plates.axis)}, {"compression", plates.compression}};
  }
  Json operator()(const model::HingeTurn& turn) const {
    return {{"kind", "hinge"}, {"wall", wall(turn.hinge)}, {"angle_deg", to_degrees(turn.angle)}};
  }
  Json operator()(const model::CordPull& cord) const {
    Json through = Json::array();
    for (const int hinge : cord.through) through.push_back(wall(hinge));
    return {{"kind", "cord"}, {"through", through}, {"shorten_mm", cord.shorten_mm}};
  }
  Json operator()(const model::ShapeMemory& hot) const {
    return {{"kind", "shape_memory"}, {"angle_deg", to_degrees(hot.angle)}, {"k_turn", hot.k_turn}};
  }
  Json operator()(const model::BodyPull&) const { return nullptr; }
};

Json hinge_json(const model::ManufacturedHinge& hinge) {
  Json out = {{"kind", to_string(hinge.kind)}, {"material", hinge.material.name}};
  if (is_pin(hinge.kind))
    out.update({{"diameter_mm", hinge.diameter_mm}, {"clearance_mm", hinge.clearance_mm}});
  else
    out.update({{"gap_mm", hinge.gap_mm}, {"thickness_mm", hinge.thickness_mm}});
  out["height_mm"] = hinge.height_mm;
  out["k"] = stiffness_json(stiffness(hinge));
  return out;
}

}  // namespace

Json lock_json(const std::optional<Lock>& lock) {
  if (!lock) return nullptr;
  return {{"kind", lock->kind},
          {"bodies", lock->bodies},
          {"distance_flat_mm", lock->flat_mm},
          {"distance_folded_mm", lock->folded_mm},
          {"force_N", lock->force_N},
          {"strength_N", lock->strength_N},
          {"material", lock->material}};
}

Json load_json(const std::optional<Folding>& folding, bool is_force) {
  const bool has_load = folding && folding->drive;
  return has_load && folding->is_force == is_force ? Json(folding->load) : Json(nullptr);
}

Json manufacture_json(const Design& design, const model::ManufacturedHinge& hinge,
                      const std::optional<Folding>& folding, const std::optional<Lock>& lock) {
  return {{"process", design.process.name},
          {"hinge", hinge_json(hinge)},
          {"drive", folding && folding->drive ? std::visit(DriveJson{design.structure}, *folding->drive)
                                              : Json(nullptr)},
          {"force_N", load_json(folding, true)},
          {"moment_Nmm", load_json(folding, false)},
          {"folds", folding ? Json(describe_effort(*folding)) : Json(nullptr)},
          {"lock", lock_json(lock)}};
}

Json compensation_json(const CompensationResult& compensation) {
  return {{"exact_mm", compensation.exact_mm},
          {"before_mm", compensation.before_mm},
          {"after_mm", compensation.after_mm},
          {"tolerance_mm", compensation.tolerance_mm},
          {"largest_change_rad", compensation.largest_change},
          {"theta_change_rad", compensation.theta_change},
          {"rounds", compensation.rounds},
          {"why", compensation.why}};
}

std::vector<SummaryLine> compensation_lines(const Run& run) {
  if (!run.compensation) return {};
  const CompensationResult& compensation = *run.compensation;
  if (!std::isfinite(compensation.after_mm))
    return {{"elastic", "no equilibrium with elastic hinges: " + compensation.why}};
  return {{"elastic",
           fmt::format(
               "{} mm rms from {} with elastic hinges, {} mm without compensation; limit of its prints {} mm",
               format_figures(compensation.after_mm), run.compared_with,
               format_figures(compensation.before_mm), format_figures(compensation.tolerance_mm))},
          {"", change_text(compensation)}};
}

namespace {

using model::ContactLimit;
using model::ContactRange;

Json limit_json(const ContactLimit& limit, const model::Lattice& sheet) {
  Json out = {{"theta_rad", limit.theta}, {"contact_rad", nullptr}, {"walls", Json::array()}};
  if (limit.contact) out["contact_rad"] = *limit.contact;
  if (limit.touches) out["walls"] = wall_names(limit.walls, sheet);
  return out;
}

Json range_json(const ContactRange& range, const model::Lattice& sheet) {
  return {{"growth_mm", range.growth_mm},
          {"low", limit_json(range.negative, sheet)},
          {"high", limit_json(range.positive, sheet)},
          {"left_out", range.touching_at_rest.size()}};
}

/// Formats the collision-free range of fold angles. Returns "nowhere" if it is 0 deg at both ends after rounding.
std::string between(const ContactRange& range) {
  constexpr double shown = 0.005 * radians_per_degree;  // smaller angles print as 0.00 deg
  if (-range.negative.theta < shown && range.positive.theta < shown) return "nowhere";
  return fmt::format("{:.2f} to {:.2f} deg", to_degrees(range.negative.theta),
                     to_degrees(range.positive.theta));
}

std::string describe_motion_end(const ContactLimit& limit, const model::Lattice& sheet) {
  if (!limit.touches) return "where the search ends";
  const auto [first, second] = wall_names(limit.walls, sheet);
  return fmt::format("limited by walls {} and {}", first, second);
}

std::string printed_range(const ProvenRanges& certified) {
  return fmt::format("with print errors, walls up to {:.2f} mm out of place: {}", certified.printed.growth_mm,
                     between(certified.printed));
}

/// Returns the lines for an equilibrium that left the closed form. The range applies to the closed form only.
std::vector<SummaryLine> left_lines(const ProvenRanges& certified, const model::Lattice& sheet,
                                    double theta) {
  return {{"contact",
           "collisions not checked: the elastic solution departs from the ideal motion that the check "
           "covers"},
          {"", fmt::format("ideal motion: collision-free {}, {}", between(certified.designed),
                           describe_motion_end(certified.designed.to(theta), sheet))},
          {"", printed_range(certified)}};
}

}  // namespace

ClosedFormRelation closed_form_relation(const Run& run) {
  if (!run.equilibrium) return ClosedFormRelation::same;
  const Equilibrium& found = *run.equilibrium;
  const bool is_near = found.turn_difference && *found.turn_difference <= model::ClosedForm::far;
  return is_near && !found.path.off_closed_form ? ClosedFormRelation::near : ClosedFormRelation::left;
}

Json certified_json(const ProvenRanges& certified, const model::Lattice& sheet, double theta,
                    ClosedFormRelation states) {
  if (!certified.designed) return {{"why_not", certified.designed.why_not}};
  return {{"design", range_json(certified.designed, sheet)},
          {"printed", range_json(certified.printed, sheet)},
          {"states_are_exact", states == ClosedFormRelation::same},
          {"states_have_left", states == ClosedFormRelation::left},
          {"covers_theta", certified.designed.covers(theta)},
          {"covers_theta_printed", certified.printed.covers(theta)}};
}

std::vector<SummaryLine> certified_lines(const ProvenRanges& certified, const model::Lattice& sheet,
                                         double theta, ClosedFormRelation states) {
  if (!certified.designed) return {{"contact", "collisions not checked: " + certified.designed.why_not}};
  if (certified.designed.overlaps_as_built())
    return {{"contact", describe_overlap(certified.designed.positive.walls, sheet)}};
  if (states == ClosedFormRelation::left) return left_lines(certified, sheet, theta);
  const std::string range = fmt::format("{}, {}", between(certified.designed),
                                        describe_motion_end(certified.designed.to(theta), sheet));
  std::vector<SummaryLine> lines = {
      certified.designed.covers(theta)
          ? SummaryLine{"contact", "collision-free " + range}
          : SummaryLine{"contact",
                        fmt::format("fold angle {:.2f} deg is outside the collision-free range, {}",
                                    to_degrees(theta), range)}};
  if (states == ClosedFormRelation::near)
    lines.push_back({"", "computed for ideal hinges; the elastic solution stays close to this motion"});
  lines.push_back({"", printed_range(certified)});
  return lines;
}

}  // namespace kinetix::app
