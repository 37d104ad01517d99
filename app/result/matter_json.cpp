#include "app/result/matter_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

std::string change_text(const MatterResult& matter) {
  return fmt::format("tilts changed by up to {:.2f} deg, theta by {:.2f} deg, in {} steps: {}",
                     to_degrees(matter.largest_change), to_degrees(matter.theta_change), matter.rounds,
                     matter.why);
}

}  // namespace

Json matter_json(const MatterResult& matter) {
  return {{"exact_mm", matter.exact_mm},
          {"before_mm", matter.before_mm},
          {"after_mm", matter.after_mm},
          {"tolerance_mm", matter.tolerance_mm},
          {"largest_change_rad", matter.largest_change},
          {"theta_change_rad", matter.theta_change},
          {"rounds", matter.rounds},
          {"why", matter.why}};
}

std::vector<SummaryLine> matter_lines(const Run& run) {
  if (!run.matter) return {};
  const MatterResult& matter = *run.matter;
  if (!std::isfinite(matter.after_mm)) return {{"matter", "NO EQUILIBRIUM: " + matter.why}};
  return {
      {"matter",
       fmt::format("with its hinges as made, points of the sheet are {:.3g} mm off {} (rms), where those of "
                   "the exact design would be {:.3g} mm off; its prints are allowed {:.3g} mm",
                   matter.after_mm, run.judged_against, matter.before_mm, matter.tolerance_mm)},
      {"", change_text(matter)}};
}

}  // namespace kinetix::app
