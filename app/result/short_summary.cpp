#include "app/result/summary.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/result/motion_evidence.hpp"
#include "app/result/verdict.hpp"
#include "app/run/design_hinges.hpp"

namespace kinetix::app {
namespace {

std::string format_sizes(const Eigen::Vector3d& mm) {
  constexpr double whole = 10;  // mm: larger sizes are in whole mm
  const auto figure = [&](double v) { return v < whole ? format_figures(v) : fmt::format("{:.0f}", v); };
  return fmt::format("{} x {} x {} mm", figure(mm.x()), figure(mm.y()), figure(mm.z()));
}

std::string format_degrees(double radians) { return format_figures(std::abs(to_degrees(radians))) + " deg"; }

/// Describes how far the sheet folds before walls collide.
std::string describe_range(const Run& run) {
  if (!run.certified) return "";
  const model::ContactRange& range = run.certified->designed;
  if (!range || closed_form_relation(run) == ClosedFormRelation::left) return "; collisions not checked";
  return "; collision-free to " + format_degrees(range.to(run.theta).theta);
}

/// Returns the line of sizes, flat and folded; of imported bodies their number.
SummaryLine size_line(const Run& run) {
  const model::Lattice& sheet = run.design.structure;
  const model::Linkage linkage = sheet;
  if (linkage.plates.empty())
    return {"bodies", fmt::format("{} bodies, {} hinges{}", sheet.bodies(), sheet.hinges(),
                                  run.closed_path ? "; " + run.closed_path->description : "")};
  std::string text = "flat " + format_sizes(flat_size(linkage));
  if (!run.states.empty() && is_finite(run.states.front().poses))
    text += fmt::format(", folded {} at {}", format_sizes(folded_size(linkage, run.states.front().poses)),
                        format_degrees(run.theta));
  return {"size", text + describe_range(run)};
}

/// Names what is assumed about the stiffness of the hinges; empty if it follows from the file or from a material.
std::string assumed_stiffness(const Design& design) {
  const std::vector<model::ManufacturedHinge> made = manufactured_hinges(design);
  if (!made.empty()) return is_pin(made.front().kind) ? "; friction of the pins is assumed" : "";
  const bool is_default = !design.hinge.k && design.hinge.k_turn == HingeSection{}.k_turn;
  return is_default ? "; hinge stiffness is assumed, set `hinge:` to change it" : "";
}

std::string describe_drive_force(const Run& run, const Folding& folding) {
  if (folding.is_unaided) return "none; springs in the hinges fold it";
  if (!folding.drive) return describe_folding(folding);
  const std::string load = format_figures(folding.load) + (folding.is_force ? " N" : " N mm on one hinge");
  return fmt::format("{} folds it {}{}{}", load, describe_effort(folding),
                     folding.is_force ? ", " + folding.name : "", assumed_stiffness(run.design));
}

std::string describe_peak_load(const Run& run) {
  const Equilibrium& equilibrium = *run.equilibrium;
  if (!equilibrium.drive.is_external()) return "none; springs in the hinges fold it";
  const double peak = largest_load(equilibrium.path), last = equilibrium.path.steps.back().load;
  return fmt::format("{} {} at most, {} at the end{}", format_figures(peak), equilibrium.drive.load_unit(),
                     format_figures(std::abs(last)), assumed_stiffness(run.design));
}

std::optional<SummaryLine> force_line(const Run& run) {
  if (run.folding && run.folding->is_possible())
    return SummaryLine{"force", describe_drive_force(run, *run.folding)};
  if (run.equilibrium) return SummaryLine{"force", describe_peak_load(run)};
  return std::nullopt;
}

/// Returns the line of prints that keep the goal. Others are problems.
std::optional<SummaryLine> print_line(const Run& run, const std::vector<SummaryLine>& of_goal) {
  const auto found = std::find_if(of_goal.begin(), of_goal.end(),
                                  [](const SummaryLine& line) { return line[0] == "print"; });
  if (found != of_goal.end()) return *found;
  if (!run.printed || !run.printed->holds()) return std::nullopt;
  const bool is_assumed = run.printed->soft && run.printed->soft->is_assumed;
  return SummaryLine{
      "print", fmt::format("{} mm rms expected, 95 % of prints within {} mm, limit {} mm; estimated for {}{}",
                           format_figures(run.printed->rms_mm()), format_figures(run.printed->p95_mm()),
                           format_figures(run.printed->tolerance_mm), run.design.process.name,
                           is_assumed ? ", assumed hinges" : "")};
}

/// Returns the line of a simulation that agrees or has no reference. Others are problems.
std::optional<SummaryLine> check_line(const Run& run) {
  if (!run.verification || !run.verification->agrees) return std::nullopt;
  const Verification& v = *run.verification;
  const double edge_mm = run.design.structure.size().edge_mm;
  if (!v.compared) return SummaryLine{"check", "rigid-body simulation settled; no state to compare with"};
  return SummaryLine{"check", fmt::format("rigid-body simulation agrees, {} mm rms from the {}; limit {} mm",
                                          format_figures(v.distance.rms * edge_mm), reference_name(run),
                                          format_figures(run.verify_tolerance * edge_mm))};
}

/// Adds lines on an equilibrium without a goal: joint separation and stable states.
void add_equilibrium_lines(const Run& run, std::vector<SummaryLine>& lines) {
  const model::StableStates& stable = run.equilibrium->stable;
  if (stable.states.size() > 1)
    lines.push_back({"stable", fmt::format("{} states: flat, {}{}", stable.states.size(),
                                           format_degrees(stable.states[1].theta),
                                           stable.states.size() > 2 ? ", ..." : "")});
  lines.push_back({"joints", fmt::format("separated by at most {} mm",
                                         format_figures(run.equilibrium->path.gaps.max *
                                                        run.design.structure.size().edge_mm))});
}

/// Quotes a folder for a shell, if it needs that.
std::string quoted_folder(const std::string& folder) {
  const auto is_safe = [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("_./-+,:=@%").find(static_cast<char>(c)) != std::string::npos;
  };
  if (std::all_of(folder.begin(), folder.end(), is_safe)) return folder;
  std::string out = "'";
  for (const char c : folder) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string next_step(const Run& run, const std::string& folder) {
  const RunVerdict verdict = verdict_of(run);
  const bool misses = !verdict.met.value_or(true) || !verdict.reaches.value_or(true);
  if (run.goal && (misses || !verdict.printable.value_or(true))) return "change the file, run again";
  if (!verdict.printable.value_or(false) || verdict.has_errors())
    return "kinetix-opt view " + quoted_folder(folder);
  return fmt::format("kinetix-opt export {} --format {}", quoted_folder(folder),
                     run.design.process.cuts_sheets() ? "dxf" : "3mf");
}

}  // namespace

ShortForm short_form(const Run& run) {
  const RunVerdict verdict = verdict_of(run);
  const std::vector<SummaryLine> of_goal =
      run.goal ? run.goal->summary_lines(run) : std::vector<SummaryLine>{};
  ShortForm out{.title = fmt::format("{}: {}", run.design.name, headline(verdict)),
                .problems = problem_lines(verdict)};
  if (!of_goal.empty()) out.lines.push_back(of_goal.front());
  out.lines.push_back(size_line(run));
  for (const auto& line : {print_line(run, of_goal), force_line(run), check_line(run)})
    if (line) out.lines.push_back(*line);
  if (run.equilibrium && !run.goal) add_equilibrium_lines(run, out.lines);
  return out;
}

std::vector<std::string> last_parts(const Run& run, const std::string& folder) {
  return {fmt::format("Report: {}/report.html", folder), "Next: " + next_step(run, folder)};
}

nlohmann::ordered_json short_json(const ShortForm& form) {
  nlohmann::ordered_json lines = nlohmann::ordered_json::array();
  for (const auto& [label, text] : form.lines) lines.push_back({{"label", label}, {"text", text}});
  return {{"title", form.title}, {"lines", std::move(lines)}};
}

std::string page_summary(ShortForm form) {
  form.details = "in Details";
  return format_short(form);
}

ShortForm short_form_of(const nlohmann::ordered_json& result) {
  using Json = nlohmann::ordered_json;
  const auto text_at = [](const Json& of, const char* key) {
    const auto found = of.is_object() ? of.find(key) : of.end();
    return of.is_object() && found != of.end() && found->is_string() ? found->get<std::string>()
                                                                     : std::string();
  };
  const auto list_at = [&](const char* section, const char* key) {
    const Json whole = result.value(section, Json(nullptr));
    const Json list = whole.is_object() ? whole.value(key, Json(nullptr)) : Json(nullptr);
    return list.is_array() ? list : Json(Json::array());
  };
  ShortForm out{.title = text_at(result.value("summary", Json(nullptr)), "title")};
  if (out.title.empty()) out.title = text_at(result, "name");
  for (const Json& line : list_at("summary", "lines"))
    out.lines.push_back({text_at(line, "label"), text_at(line, "text")});
  for (const Json& problem : list_at("verdict", "problems"))
    out.problems.push_back({text_at(problem, "level"), text_at(problem, "text")});
  return out;
}

}  // namespace kinetix::app
