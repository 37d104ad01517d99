#include "app/result/as_made_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/result/made_hinges.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_sources = 10;  // that a person would look at
constexpr const char* parameters[] = {"t", "alpha", "beta", "offset"};
constexpr const char* parameter_words[] = {"the place", "the direction", "the tilt", "the offset"};

std::string prints_words(const PrintedGoal& printed) {
  const model::PrintRuns& runs = *printed.runs;
  std::string text =
      fmt::format("{} prints in the elastic model: {:.2f} mm off (rms), 95 of 100 within {:.2f} mm",
                  runs.prints, runs.rms_mm, runs.p95_mm);
  if (runs.failed > 0) text += fmt::format("; {} more found no equilibrium near the design", runs.failed);
  return text + (printed.is_confirmed() ? "" : ": FIRST ORDER DOES NOT HOLD");
}

}  // namespace

Json as_made_json(const Run& run) {
  const model::AsMade& made = run.printed->made;
  Json sources = Json::array();
  for (std::size_t k = 0; k < std::min(made.sources.size(), most_sources); ++k)
    sources.push_back({{"hinge", made.sources[k].hinge},
                       {"parameter", parameters[made.sources[k].parameter]},
                       {"share", made.sources[k].share}});
  Json out = {{"process", run.process.name},
              {"sd",
               {{"t_mm", run.process.sd.t_mm},
                {"tilt_deg", run.process.sd.tilt_deg},
                {"clearance_mm", run.process.sd.clearance_mm}}},
              {"designed_mm", made.designed_mm},
              {"rms_mm", made.rms_mm},
              {"p95_mm", made.p95_mm},
              {"tolerance_mm", run.printed->tolerance_mm},
              {"can_be_printed", run.printed->can_be_printed},
              {"holds", run.printed->holds()},
              {"why", as_made_reasons(run)},
              {"confirmed", run.printed->is_confirmed()},
              {"sources", sources}};
  if (const auto& runs = run.printed->runs)
    out["prints"] = {{"count", runs->prints},
                     {"failed", runs->failed},
                     {"rms_mm", runs->rms_mm},
                     {"p95_mm", runs->p95_mm}};
  return out;
}

std::vector<std::string> as_made_reasons(const Run& run) {
  const PrintedGoal& printed = *run.printed;
  std::vector<std::string> why = unprintable(run);
  if (printed.made.p95_mm > printed.tolerance_mm)
    why.push_back(fmt::format("95 of 100 prints stay within {:.2f} mm of the goal, and {:.2f} mm are allowed",
                              printed.made.p95_mm, printed.tolerance_mm));
  if (!printed.runs) return why;
  const model::PrintRuns& runs = *printed.runs;
  if (runs.failed > 0)
    why.push_back(fmt::format("{} of {} prints in the elastic model found no equilibrium near the design",
                              runs.failed, runs.prints + runs.failed));
  if (runs.p95_mm > printed.tolerance_mm)
    why.push_back(
        fmt::format("of {} prints in the elastic model 95 of 100 came within {:.2f} mm of the goal, and "
                    "{:.2f} mm are allowed",
                    runs.prints, runs.p95_mm, printed.tolerance_mm));
  return why;
}

std::vector<SummaryLine> as_made_lines(const Run& run) {
  if (!run.prints_unknown.empty())
    return {{"as made", "what prints come to is not known: " + run.prints_unknown}};
  if (!run.printed) return {};
  const model::AsMade& made = run.printed->made;
  std::vector<SummaryLine> lines = {
      {"as made",
       fmt::format(
           "printed by {}: {:.2f} mm off (rms), 95 of 100 prints within {:.2f} mm; {:.2f} mm are allowed: {}",
           run.process.name, made.rms_mm, made.p95_mm, run.printed->tolerance_mm,
           run.printed->holds() ? "holds" : "NOT EVERY PRINT HOLDS")}};
  if (!made.sources.empty()) {
    const model::ScatterSource& most = made.sources.front();
    lines.push_back(
        {"", fmt::format("largest single source: {} of the hinge on wall {}, {:.0f} % of what errors do",
                         parameter_words[most.parameter], wall_name(run.structure, most.hinge),
                         100 * most.share)});
  }
  if (run.printed->runs) lines.push_back({"", prints_words(*run.printed)});
  if (run.hinge.model == HingeSection::Model::rotary)
    lines.push_back(
        {"", fmt::format("taken for pins of {:g} N/mm, as the file does not say what its hinges are: "
                         "`hinge: {{kind: block, ...}}` tells what soft ones come to",
                         run.hinge.k_point)});
  return lines;
}

}  // namespace kinetix::app
