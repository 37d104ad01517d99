#include "app/result/verdict.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <set>

#include "app/console/short_form.hpp"
#include "app/pipeline/physics.hpp"
#include "app/result/motion_evidence.hpp"
#include "app/result/print_evidence.hpp"
#include "app/run/design_hinges.hpp"
#include "model/assembly/assembly.hpp"

namespace kinetix::app {
namespace {

using Flag = std::optional<bool> RunVerdict::*;
using Reasons = std::vector<std::string>;

struct NamedFlag {
  const char* name;
  Flag flag;
};

constexpr NamedFlag flags[] = {{"met", &RunVerdict::met},
                               {"agrees", &RunVerdict::agrees},
                               {"printable", &RunVerdict::printable},
                               {"reaches", &RunVerdict::reaches}};

const char* flag_name(Flag flag) {
  return std::find_if(std::begin(flags), std::end(flags), [&](const NamedFlag& f) { return f.flag == flag; })
      ->name;
}

std::string kinds_of(const model::Assembly& bodies) {
  std::set<std::string> kinds;
  for (const model::AssemblyHinge& h : bodies.hinges) kinds.insert(h.ball ? "ball" : to_string(h.kind));
  return fmt::format("{}", fmt::join(kinds, ", "));
}

/// Names the kinds of hinges in the states: those of the file, else those that the model assumes.
std::string hinges_of_model(const Run& run) {
  if (const model::Assembly* bodies = run.design.structure.assembly()) return kinds_of(*bodies);
  std::vector<std::string> kinds;
  for (const model::ManufacturedHinge& made : manufactured_hinges(run.design))
    if (std::find(kinds.begin(), kinds.end(), to_string(made.kind)) == kinds.end())
      kinds.push_back(to_string(made.kind));
  if (!kinds.empty()) return fmt::format("{}", fmt::join(kinds, ", "));
  return run.equilibrium || run.design.hinge.model == HingeSection::Model::elastic ? "elastic" : "rotary";
}

Reasons agreement_reasons(const Run& run) {
  const Verification& v = *run.verification;
  if (v.agrees) return {};
  if (!is_settled(v)) return {failed_simulation_reason(v)};
  Reasons why = run.physics_violations();
  if (v.compared && !(v.distance.rms <= run.verify_tolerance)) {
    const double edge_mm = run.design.structure.size().edge_mm;
    why.push_back(fmt::format("the simulation ends {} mm rms from the {}, limit {} mm{}",
                              format_figures(v.distance.rms * edge_mm), reference_name(run),
                              format_figures(run.verify_tolerance * edge_mm),
                              v.equilibrium ? ": " + v.equilibrium->why : ""));
  }
  return why;
}

std::string advice_of(const Run& run) { return run.print ? run.print->advice : ""; }

Reasons print_reasons(const Run& run) {
  return run.print->is_accepted ? Reasons{} : Reasons{run.print->why + run.print->advice};
}

/// Checks whether no drive is known to fold a sheet that can be printed, nor that none does.
bool has_unknown_drive(const Run& run) {
  return run.goal && run.print && run.print->is_accepted && !run.folding && !run.equilibrium;
}

/// Returns the reasons why the drive does not reach the reported state; nullopt if the run has no model of the drive, or
/// does not know it.
std::optional<Reasons> drive_reasons(const Run& run) {
  Reasons why;
  if (run.compensation && !run.equilibrium)
    return Reasons{"elastic hinges find no equilibrium: " + run.compensation->why};
  if (run.equilibrium) {
    if (!run.goal)
      why = drive_reasons(*run.equilibrium, run.theta);
    else if (!run.equilibrium->reached())
      why.push_back(drive_stop_reason(run.equilibrium->path));
  } else if (run.closed_path) {
    return run.closed_path->missed;
  } else if (run.plan.model != Model::exact || run.states.empty()) {
    return std::nullopt;
  } else if (auto contact = contact_reason(run)) {
    why.push_back(std::move(*contact));
  }
  if (run.folding && !run.equilibrium && describe_effort(*run.folding) == "no")
    why.push_back(describe_folding(*run.folding) + advice_of(run));
  if (!run.states.empty())
    if (auto strained = describe_overstrain(run.design, run.states.front().poses))
      why.push_back(std::move(*strained));
  if (why.empty() && has_unknown_drive(run)) return std::nullopt;
  return why;
}

void warn_all(RunVerdict& verdict, const Reasons& texts) {
  for (const std::string& text : texts) verdict.warn(text);
}

/// Adds the warnings of all parts of the run; they do not change a flag. New warnings belong here, those of a goal kind
/// in its Measure::warnings.
void add_warnings(const Run& run, RunVerdict& verdict) {
  if (run.stopped) verdict.warn("stopped early: this is the best result so far");
  if (run.plan.is_floppy())
    verdict.warn(
        fmt::format("underconstrained: {} degrees of freedom. Driving one leaves the rest undetermined. Add "
                    "bracing walls or set `structure.rim: closed`",
                    run.plan.mobility->dofs_along));
  for (const auto& [label, words] : hinge_problem_lines(run))
    if (label != "STRAINED") verdict.warn(words);  // STRAINED is an error of `reaches`
  if (!run.goal) return;
  if (!run.met()) warn_all(verdict, run.physics_violations());
  warn_all(verdict, shown_measure(run).warnings);
  if (has_unknown_drive(run)) verdict.warn("the drive that folds it is unknown" + advice_of(run));
  if (run.print && !run.print->warning.empty()) verdict.warn(run.print->warning);
  if (!run.prints_unknown.empty()) verdict.warn("print tolerance is unknown: " + run.prints_unknown);
  if (run.printed) warn_all(verdict, scatter_warnings(run));
}

/// Returns the field's terms for kinds of hinges: "pin, living" for "pin, film".
std::string hinge_terms(std::string kinds) {
  for (const auto& [key, term] : {std::pair("block", "elastomer"), std::pair("film", "living")})
    if (const std::size_t at = kinds.find(key); at != std::string::npos)
      kinds.replace(at, std::string_view(key).size(), term);
  return kinds;
}

nlohmann::ordered_json flag_json(const std::optional<bool>& flag) {
  return flag ? nlohmann::ordered_json(*flag) : nlohmann::ordered_json(nullptr);
}

const char* level_name(Problem::Level level) { return level == Problem::Level::error ? "error" : "warning"; }

}  // namespace

void RunVerdict::set(Flag flag, const Reasons& reasons, const std::string& hinge) {
  this->*flag = reasons.empty();
  hinges.emplace_back(flag_name(flag), hinge);
  for (const std::string& text : reasons) {
    const auto says = [&](const Problem& p) {  // the text of a problem may have advice after it
      return p.level == Problem::Level::error && p.text.starts_with(text);
    };
    if (std::none_of(problems.begin(), problems.end(), says))
      problems.push_back({Problem::Level::error, text});
  }
}

void RunVerdict::warn(const std::string& text) {
  const auto same = [&](const Problem& p) { return p.text == text; };
  if (std::none_of(problems.begin(), problems.end(), same))
    problems.push_back({Problem::Level::warning, text});
}

bool RunVerdict::has_errors() const {
  return std::any_of(problems.begin(), problems.end(),
                     [](const Problem& p) { return p.level == Problem::Level::error; });
}

std::string RunVerdict::reasons() const {
  std::string out;
  for (const Problem& p : problems)
    if (p.level == Problem::Level::error) out += (out.empty() ? "" : "; ") + p.text;
  return out;
}

Reasons drive_reasons(const Equilibrium& equilibrium, double theta) {
  Reasons why;
  if (!equilibrium.reached()) why.push_back(drive_stop_reason(equilibrium.path));
  if (equilibrium.is_on_the_other_side(theta)) why.push_back(describe_missed_drive(equilibrium, theta));
  return why;
}

std::string failed_simulation_reason(const Verification& v) {
  return fmt::format("the simulation failed, {}: {}", to_string(v.physics.status), v.physics.why);
}

RunVerdict verdict_of(const Run& run) {
  RunVerdict out;
  const std::string hinges = hinges_of_model(run);
  if (run.goal) out.set(&RunVerdict::met, run.violations, hinges);
  if (const model::BodyPull* pull = body_pull_of(run.design); pull && pull->poses)
    out.set(&RunVerdict::met, run.closed_path->missed, hinges);
  if (run.verification) out.set(&RunVerdict::agrees, agreement_reasons(run), hinges);
  if (run.print) out.set(&RunVerdict::printable, print_reasons(run), run.print->hinges);
  if (const auto why = drive_reasons(run)) out.set(&RunVerdict::reaches, *why, hinges);
  add_warnings(run, out);
  return out;
}

ExitCode exit_code(const RunVerdict& verdict) {
  const auto is_false = [&](Flag flag) { return !(verdict.*flag).value_or(true); };
  if (is_false(&RunVerdict::met) || is_false(&RunVerdict::printable) || is_false(&RunVerdict::reaches))
    return target_missed;
  return is_false(&RunVerdict::agrees) ? physics_disagrees : done;
}

nlohmann::ordered_json verdict_json(const RunVerdict& verdict) {
  using Json = nlohmann::ordered_json;
  Json out, hinges = Json::object(), problems = Json::array();
  for (const NamedFlag& f : flags) out[f.name] = flag_json(verdict.*f.flag);
  for (const auto& [flag, kind] : verdict.hinges) hinges[flag] = kind;
  for (const Problem& p : verdict.problems)
    problems.push_back({{"level", level_name(p.level)}, {"text", p.text}});
  out["hinges"] = std::move(hinges);
  out["problems"] = std::move(problems);
  return out;
}

std::string headline(const RunVerdict& verdict) {
  Reasons parts;
  const auto add = [&](Flag flag, const std::string& yes, const std::string& no) {
    if (verdict.*flag) parts.push_back(*(verdict.*flag) ? yes : no);
  };
  add(&RunVerdict::met, "goal met", "goal missed");
  const auto kind = std::find_if(verdict.hinges.begin(), verdict.hinges.end(),
                                 [](const auto& hinge) { return hinge.first == "printable"; });
  const std::string with = kind != verdict.hinges.end() ? hinge_terms(kind->second) : "";
  add(&RunVerdict::printable, "printable with " + with + " hinges", "not printable");
  if (!verdict.met || !verdict.reaches.value_or(true))
    add(&RunVerdict::reaches, "reached by its drive", "not reached by its drive");
  if (verdict.met && verdict.printable.value_or(false) && !verdict.reaches) parts.push_back("drive unknown");
  add(&RunVerdict::agrees, "simulation agrees", "simulation disagrees");
  return parts.empty() ? "computed" : fmt::format("{}", fmt::join(parts, ", "));
}

std::vector<SummaryLine> problem_lines(const RunVerdict& verdict) {
  std::vector<SummaryLine> lines;
  for (const Problem& p : verdict.problems) lines.push_back({level_name(p.level), p.text});
  return lines;
}

}  // namespace kinetix::app
