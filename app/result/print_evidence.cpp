#include "app/result/print_evidence.hpp"

#include <fmt/format.h>
#include <cctype>
#include <nlohmann/json.hpp>

#include "app/console/short_form.hpp"
#include "app/files/process_section.hpp"
#include "app/result/motion_evidence.hpp"
#include "app/run/design_hinges.hpp"

namespace kinetix::app {
namespace {

/// Elastomer or living hinge in the reported state.
struct Turned {
  int hinge;
  const model::ManufacturedHinge* made;
  double turn;    ///< absolute value, rad
  double strain;  ///< strain by bending and stretching, ratio
};

std::vector<Turned> turned_hinges(const Run& run) {
  std::vector<Turned> all;
  if (run.states.empty() || !(run.design.hinge.made || !run.design.hinge_overrides.empty())) return all;
  const model::Linkage linkage(run.design.structure);
  for (int h = 0; h < run.design.structure.hinges(); ++h) {
    const auto& made = hinge_section(run.design, h).made;
    if (!made || is_pin(made->kind)) continue;
    const model::State& state = run.states.front().poses;
    all.push_back(
        {h, &*made, std::abs(hinge_turn(linkage, state, h)), hinge_strain(*made, linkage, state, h)});
  }
  return all;
}

double strain_share(const Turned& t) { return t.strain / t.made->material.strain_max; }

double corner_turn(const Run& run, const Turned& t) {
  const model::CellSize size = run.design.structure.size();
  return contact_turn(*t.made, size.thickness_mm, run.design.structure.hinge(t.hinge).offset * size.edge_mm);
}

/// Returns the hinge with the largest value if that value is above 1, else nullptr.
template <class Value>
const Turned* worst(const std::vector<Turned>& all, const Value& value) {
  const auto at = std::max_element(all.begin(), all.end(),
                                   [&](const Turned& a, const Turned& b) { return value(a) < value(b); });
  return at != all.end() && value(*at) > 1 ? &*at : nullptr;
}

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

std::optional<HingeStrain> worst_strain(const Run& run) {
  const std::vector<Turned> all = turned_hinges(run);
  const auto most = std::max_element(all.begin(), all.end(), [](const Turned& a, const Turned& b) {
    return strain_share(a) < strain_share(b);
  });
  if (most == all.end()) return std::nullopt;
  return HingeStrain{most->strain, most->made->material.strain_max};
}

std::vector<std::string> unprintable(const Run& run) {
  std::vector<std::string> all;
  if (!run.goal) return all;
  if (run.print && !run.print->is_accepted) all.push_back(run.print->why + run.print->advice);
  if (run.print) return all;
  for (const model::PrintProblem& problem : print_problems(run.design)) all.push_back(problem.what);
  return all;
}

std::vector<std::pair<std::string, std::string>> hinge_problem_lines(const Run& run) {
  std::vector<std::pair<std::string, std::string>> lines;
  for (const std::string& what : unprintable(run)) lines.emplace_back("PRINT", what);
  const std::vector<Turned> all = turned_hinges(run);
  if (const Turned* t = worst(all, strain_share))
    lines.emplace_back("STRAINED", describe_strain({t->hinge, t->strain, t->made->material.strain_max},
                                                   wall_name(run.design.structure, t->hinge)));
  const auto corners = [&](const Turned& t) { return t.turn / corner_turn(run, t); };
  if (const Turned* t = worst(all, corners))
    lines.emplace_back(
        "CORNERS",
        fmt::format("the two halves of wall {} collide at a turn of {:.1f} deg, and this design turns "
                    "it by {:.1f} deg. Use a longer gap (`gap_mm`)",
                    wall_name(run.design.structure, t->hinge), corner_turn(run, *t) / radians_per_degree,
                    t->turn / radians_per_degree));
  return lines;
}

nlohmann::ordered_json hinge_problems_json(const Run& run) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const auto& [label, words] : hinge_problem_lines(run))
    out.push_back({{"kind", lower_case(label)}, {"what", words}});
  return out;
}

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_sources = 10;  // length of lists: enough for a reader
constexpr const char* parameters[] = {"t", "alpha", "beta", "offset"};
constexpr const char* parameter_names[] = {"position", "direction", "tilt", "offset"};

std::string format_share(double share) {
  return share < 0.01 ? "under 1 %" : fmt::format("{:.0f} %", 100 * share);
}

/// Describes the simulated prints. @param goal reference of the distances, in words
std::string describe_sample_prints(const PrintedGoal& printed, const std::string& goal) {
  const model::PrintRuns& runs = *printed.runs;
  if (runs.prints == 0)
    return fmt::format(
        "none of {} simulated prints has an equilibrium near the design, so the print tolerance is unknown",
        runs.failed);
  std::string text =
      fmt::format("{} simulated prints: {} mm rms from {}, {} of them within {} mm", runs.prints,
                  format_figures(runs.rms_mm), goal, runs.kept(), format_figures(runs.p95_mm));
  if (runs.failed > 0) text += fmt::format("; {} more have no equilibrium near the design", runs.failed);
  return text + (printed.is_confirmed() ? "" : "; the linear estimate is far from them");
}

/// Describes whether prints of a sheet stay within the limit.
std::string describe_print_verdict(const Run& run) {
  const PrintedGoal& printed = *run.printed;
  if (!printed.can_be_printed) return "not printable";
  if (!printed.holds()) return "not every print stays within it";
  if (!run.met()) return "OK, but the design itself misses the goal";
  if (printed.touches_too_often())
    return fmt::format("OK, but walls touch in {:.0f} % of prints", 100 * printed.touching->share());
  if (!printed.free_of_contact) return "OK, but collisions were not checked";
  return *printed.free_of_contact ? "OK" : "OK, but walls may collide";
}

Json soft_hinges_json(const SoftHinges& soft) {
  Json out = {{"kind", to_string(soft.made.kind)},
              {"material", soft.made.material.name},
              {"gap_mm", soft.made.gap_mm},
              {"thickness_mm", soft.made.thickness_mm},
              {"height_mm", soft.made.height_mm},
              {"strain", soft.strain},
              {"strain_allowed", soft.made.material.strain_max},
              {"assumed", soft.is_assumed}};
  return out;
}

/// Warns if the fold is outside the collision-free range of prints; nullopt if it is inside, or no range is proven.
std::optional<std::string> describe_contact(const Run& run) {
  if (run.printed->free_of_contact.value_or(true) || run.certified->printed.covers(run.theta))
    return std::nullopt;
  return fmt::format(
      "printed walls may collide: this design folds to {:.1f} deg, the collision-free range with print "
      "errors "
      "ends at {:.1f} deg",
      std::abs(to_degrees(run.theta)), std::abs(to_degrees(run.certified->printed.to(run.theta).theta)));
}

/// Describes the share of simulated prints whose walls touch during the motion; nullopt if it is zero or unknown.
std::optional<std::string> describe_touching(const PrintedGoal& printed) {
  if (!printed.touching || printed.touching->share() == 0) return std::nullopt;
  return fmt::format("walls touch during folding in {:.0f} +- {:.0f} % of {} simulated prints{}",
                     100 * printed.touching->share(), 100 * printed.touching->error(),
                     printed.touching->prints,
                     printed.touches_too_often()
                         ? ". Leave more room between walls that end near each other, or use a finer process"
                         : "");
}

/// Describes prints that plates may fold to the other side, with advice; nullopt if there are none.
std::optional<std::string> describe_flat_starts(const PrintedGoal& printed) {
  if (!printed.from_flat || !printed.from_flat->need_guidance()) return std::nullopt;
  const model::FlatStarts& starts = *printed.from_flat;
  std::string text = fmt::format("pressed from flat, of {} simulated prints ", starts.prints);
  if (starts.other_side > 0) text += fmt::format("{} fold in the opposite direction", starts.other_side);
  if (starts.other_side > 0 && starts.either_side > 0) text += " and ";
  if (starts.either_side > 0) text += fmt::format("{} fold in either direction", starts.either_side);
  return text + ". Bend the sheet a little in its fold direction before you press it";
}

/// Returns the trade name of a material for a sentence. Other names are as in files.
std::string trade_name(const std::string& material) {
  if (material == "tango") return "Tango";
  if (material == "tpu95a") return "TPU 95A";
  return material == "pp" ? "polypropylene" : material;
}

std::string describe_soft_hinges(const SoftHinges& soft) {
  const model::ManufacturedHinge& block = soft.made;
  return fmt::format("{}hinges: {} {} {:.1f} mm long, peak strain {:.2g} (limit {:g})",
                     soft.is_assumed ? "assumed " : "", trade_name(block.material.name),
                     block.kind == model::HingeKind::film ? "living hinge" : to_string(block.kind),
                     block.gap_mm, soft.strain, block.material.strain_max);
}

/// Returns the reasons why prints leave the goal, one sentence each. Empty if they keep it.
std::vector<std::string> scatter_reasons(const Run& run) {
  const PrintedGoal& printed = *run.printed;
  std::vector<std::string> why;
  if (printed.p95_mm() > printed.tolerance_mm)
    why.push_back(
        fmt::format("prints may miss the limit: 95 % stay within {} mm of {}, the limit is {} mm "
                    "(estimated for {})",
                    format_figures(printed.p95_mm()), run.compared_with, format_figures(printed.tolerance_mm),
                    run.design.process.name));
  if (!printed.runs) return why;
  const model::PrintRuns& runs = *printed.runs;
  if (runs.failed > 0)
    why.push_back(fmt::format("{} of {} simulated prints have no equilibrium near the design", runs.failed,
                              runs.prints + runs.failed));
  if (runs.prints > 0 && runs.p95_mm > printed.tolerance_mm)
    why.push_back(fmt::format("{} of {} simulated prints stay within {} mm of {}, the limit is {} mm",
                              runs.kept(), runs.prints, format_figures(runs.p95_mm), run.compared_with,
                              format_figures(printed.tolerance_mm)));
  return why;
}

}  // namespace

std::vector<ScatterShare> sources_by_place(const Run& run) {
  const model::Structure* squares = run.design.structure.squares();
  if (!squares || !run.printed) return {};
  std::map<std::pair<std::string, int>, double> shares;
  for (const model::ScatterSource& source : run.printed->made.sources) {
    const model::Wall& wall = squares->hinges[static_cast<std::size_t>(source.hinge)].wall;
    shares[{line_name(wall, run.is_strip), source.parameter}] += source.share;
  }
  std::vector<ScatterShare> out;
  for (const auto& [at, share] : shares) out.push_back({at.first, at.second, share});
  std::stable_sort(out.begin(), out.end(),
                   [](const ScatterShare& a, const ScatterShare& b) { return a.share > b.share; });
  return out;
}

Json print_tolerance_json(const Run& run) {
  const model::ToleranceResult& made = run.printed->made;
  Json sources = Json::array();
  for (std::size_t k = 0; k < std::min(made.sources.size(), max_sources); ++k)
    sources.push_back({{"hinge", made.sources[k].hinge},
                       {"parameter", parameters[made.sources[k].parameter]},
                       {"share", made.sources[k].share}});
  Json places = Json::array();
  const std::vector<ScatterShare> all = sources_by_place(run);
  for (std::size_t k = 0; k < std::min(all.size(), max_sources); ++k)
    places.push_back(
        {{"place", all[k].place}, {"parameter", parameters[all[k].parameter]}, {"share", all[k].share}});
  Json out = {{"process", run.design.process.name},
              {"sd",
               {{"t_mm", run.design.process.sd.t_mm},
                {"tilt_deg", run.design.process.sd.tilt_deg},
                {"clearance_mm", run.design.process.sd.clearance_mm}}},
              {"designed_mm", made.designed_mm},
              {"rms_mm", run.printed->rms_mm()},
              {"p95_mm", run.printed->p95_mm()},
              {"first_order_rms_mm", made.rms_mm},
              {"tolerance_mm", run.printed->tolerance_mm},
              {"can_be_printed", run.printed->can_be_printed},
              {"holds", run.printed->holds()},
              {"why", print_failure_reasons(run)},
              {"free_of_contact", nullptr},
              {"confirmed", run.printed->is_confirmed()},
              {"sources", sources},
              {"places", places}};
  if (const auto& is_free = run.printed->free_of_contact) out["free_of_contact"] = *is_free;
  out["touching_share"] = nullptr;
  if (const auto& touching = run.printed->touching) {
    out["touching_share"] = touching->share();
    out["touching_error"] = touching->error();
    out["touching_prints"] = touching->prints;
    out["touching_settled"] = touching->settled;
  }
  if (const auto& starts = run.printed->from_flat)
    out["from_flat"] = {{"prints", starts->prints},
                        {"other_side", starts->other_side},
                        {"either_side", starts->either_side},
                        {"failed", starts->failed}};
  if (run.printed->soft) out["taken"] = soft_hinges_json(*run.printed->soft);
  if (const auto& tight = run.printed->without_clearance)
    out["play"] = {{"clearance_mm", loosest_pin(run.design)->clearance_mm},
                   {"tilt_deg", to_degrees(clearance_tilt(*loosest_pin(run.design)))},
                   {"rms_without_mm", tight->rms_mm},
                   {"p95_without_mm", tight->p95_mm}};
  if (const auto& runs = run.printed->runs)
    out["prints"] = {{"count", runs->prints},
                     {"failed", runs->failed},
                     {"rms_mm", runs->rms_mm},
                     {"p95_mm", runs->p95_mm},
                     {"kept", runs->kept()}};
  return out;
}

std::vector<std::string> print_failure_reasons(const Run& run) {
  std::vector<std::string> why = unprintable(run);
  for (std::string& reason : scatter_reasons(run)) why.push_back(std::move(reason));
  return why;
}

std::vector<std::string> scatter_warnings(const Run& run) {
  std::vector<std::string> all = scatter_reasons(run);
  if (auto contact = describe_contact(run)) all.push_back(std::move(*contact));
  if (run.printed->touches_too_often()) all.push_back(*describe_touching(*run.printed));
  if (auto starts = describe_flat_starts(*run.printed)) all.push_back(std::move(*starts));
  if (run.printed->runs && !run.printed->is_confirmed())
    all.push_back(describe_sample_prints(*run.printed, run.compared_with));
  return all;
}

std::vector<SummaryLine> print_tolerance_lines(const Run& run) {
  if (!run.printed) return {};
  const model::ToleranceResult& made = run.printed->made;
  const std::string& process = run.design.process.name;
  std::vector<SummaryLine> lines = {
      {"print",
       fmt::format("print tolerance ({}, estimated): {} mm rms expected, 95 % of prints within {} mm of "
                   "{}, limit {} mm: {}",
                   process, format_figures(run.printed->rms_mm()), format_figures(run.printed->p95_mm()),
                   run.compared_with, format_figures(run.printed->tolerance_mm),
                   describe_print_verdict(run))},
      {"", fmt::format("error of the design itself at these points: {} mm rms",
                       format_figures(made.designed_mm))}};
  if (const auto touching = describe_touching(*run.printed); touching && !run.printed->touches_too_often())
    lines.push_back({"", *touching});  // a larger share is reported as a warning
  if (const auto places = sources_by_place(run); !places.empty())
    lines.push_back({"", fmt::format("main error source: {} in {}, {} of the variance",
                                     parameter_names[places[0].parameter], places[0].place,
                                     format_share(places[0].share))});
  if (!made.sources.empty()) {
    const model::ScatterSource& most = made.sources.front();
    lines.push_back({"", fmt::format("main single source: {} of the hinge at wall {}, {} of the variance",
                                     parameter_names[most.parameter],
                                     wall_name(run.design.structure, most.hinge), format_share(most.share))});
  }
  if (const auto& tight = run.printed->without_clearance)
    lines.push_back(
        {"", fmt::format(
                 "joint clearance {:g} mm per side, {:.2f} deg; without it {} mm rms, 95 % within {} mm",
                 loosest_pin(run.design)->clearance_mm, to_degrees(clearance_tilt(*loosest_pin(run.design))),
                 format_figures(tight->rms_mm), format_figures(tight->p95_mm))});
  if (run.printed->runs) lines.push_back({"", describe_sample_prints(*run.printed, run.compared_with)});
  if (run.printed->soft) {
    lines.push_back({"", describe_soft_hinges(*run.printed->soft)});
    lines.push_back({"", "to evaluate other hinges, set `hinge:` and `drive:` in the target file"});
  }
  return lines;
}

}  // namespace kinetix::app
