#include "app/result/robust_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

std::string words(const RobustCandidate& one) {
  std::string text = fmt::format("theta {:.1f} deg", one.theta / radians_per_degree);
  if (one.gap_mm) text += fmt::format(" and gaps of {:.2g} mm", *one.gap_mm);
  return text + (std::isfinite(one.as_made_mm) ? fmt::format(", {:.3g} mm", one.as_made_mm) : ", not known") +
         (one.is_allowed ? "" : " (not to be taken: " + one.why_not + ")");
}

}  // namespace

Json robust_json(const Run& run) {
  Json out = Json::array();
  for (std::size_t k = 0; k < run.robust->tried.size(); ++k) {
    const RobustCandidate& one = run.robust->tried[k];
    out.push_back({{"theta_rad", one.theta},
                   {"cell_mm", one.cell_mm},
                   {"gap_mm", one.gap_mm ? Json(*one.gap_mm) : Json(nullptr)},
                   {"designed_mm", one.designed_mm},
                   {"as_made_rms_mm", one.as_made_mm},
                   {"as_made_p95_mm", one.as_made_p95},
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
    return {
        {"robust",
         fmt::format("of {} designs tried, prints of none that may be taken come nearer than those of the "
                     "plain search's{}",
                     run.robust->tried.size(), plain.is_allowed ? "" : ", " + words(plain))}};
  return {
      {"robust",
       fmt::format("of {} designs tried, that whose prints are expected nearest: {}; the plain search's: {}",
                   run.robust->tried.size(), words(best), words(plain))}};
}

}  // namespace kinetix::app
