#include "app/result/made_hinges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/files/process_section.hpp"
#include "app/run/design_hinges.hpp"
#include "model/closure/closure_drive.hpp"
#include "model/matter/hinge_strain.hpp"

namespace kinetix::app {
namespace {

/// Elastomer or living hinge in the reported state.
struct Turned {
  int hinge;
  const model::MadeHinge* made;
  double turn;    ///< absolute value, rad
  double strain;  ///< strain by bending and stretching, ratio
};

std::vector<Turned> turned_hinges(const Run& run) {
  std::vector<Turned> all;
  if (run.states.empty() || !(run.design.hinge.made || !run.design.hinge_overrides.empty())) return all;
  const model::Linkage linkage(run.design.structure);
  for (int h = 0; h < run.design.structure.hinges(); ++h) {
    const auto& made = hinge_section(run.design, h).made;
    if (!made || made->kind == model::HingeKind::pin) continue;
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

/// Returns label and text for the made hinge, pins included, whose offset exceeds the limit of its kind the most.
std::optional<std::pair<std::string, std::string>> offset_line(const Run& run) {
  const model::CellSize size = run.design.structure.size();
  std::optional<std::pair<std::string, std::string>> line;
  double worst = 1e-9 * size.edge_mm;  // mm: rounding of a file's digits
  for (int h = 0; h < run.design.structure.hinges(); ++h) {
    const auto& made = hinge_section(run.design, h).made;
    if (!made) continue;
    const double offset = std::abs(run.design.structure.hinge(h).offset) * size.edge_mm;
    const double most = largest_offset_mm(*made, size);
    if (!(offset - most > worst)) continue;
    worst = offset - most;
    line = {
        "OFFSET",
        fmt::format(
            "the offset of the hinge of wall {} is {:.2f} mm; made so in this wall it can be {:.2f} at most",
            wall_name(run.design.structure, h), offset, most)};
  }
  return line;
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
  for (const model::PrintProblem& problem : print_problems(run.design)) all.push_back(problem_text(problem));
  if (all.empty() && run.print && !run.print->is_taken) all.push_back(run.print->why);
  return all;
}

std::vector<std::pair<std::string, std::string>> made_hinge_lines(const Run& run) {
  std::vector<std::pair<std::string, std::string>> lines;
  for (const std::string& what : unprintable(run)) lines.emplace_back("PRINT", what);
  const std::vector<Turned> all = turned_hinges(run);
  if (const Turned* t = worst(all, strain_share))
    lines.emplace_back("STRAINED", strained_words({t->hinge, t->strain, t->made->material.strain_max},
                                                  wall_name(run.design.structure, t->hinge)));
  const auto corners = [&](const Turned& t) { return t.turn / corner_turn(run, t); };
  if (const Turned* t = worst(all, corners))
    lines.emplace_back(
        "CORNERS", fmt::format("corners of the two halves of wall {} meet where it has turned by {:.1f} deg; "
                               "here by {:.1f}: a longer gap lets it turn further",
                               wall_name(run.design.structure, t->hinge),
                               corner_turn(run, *t) / radians_per_degree, t->turn / radians_per_degree));
  if (const auto offset = offset_line(run)) lines.push_back(*offset);
  return lines;
}

nlohmann::ordered_json made_problems_json(const Run& run) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const auto& [label, words] : made_hinge_lines(run))
    out.push_back({{"kind", lower_case(label)}, {"what", words}});
  return out;
}

}  // namespace kinetix::app
