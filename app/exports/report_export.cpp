#include "app/exports/report_export.hpp"

#include <nlohmann/json.hpp>

#include "app/io/base64.hpp"
#include "app/report/light_result.hpp"
#include "app/report/report.hpp"
#include "app/viewer/assets.hpp"

namespace kinetix::app {
namespace {

/// The result with the pictures that belong into the page itself, without the time of writing: it is not known yet.
std::vector<NamedContent> write_report(const Run& run, const nlohmann::ordered_json& result) {
  if (run.way) return {};  // the page draws walls
  nlohmann::ordered_json shown = result;
  shown["timing_s"].erase("write");
  if (run.goal)
    for (const auto& [name, png] : run.goal->pictures(run, true))
      shown["pictures"][name] = "data:image/png;base64," + to_base64(png);
  return {{"report.html", report_html(light_result(std::move(shown), !scene_script().empty()).dump())}};
}

}  // namespace

// Name, extensions, whether every run writes it, and how: report.html.
const Exporter report_export = {"report", {"html"}, true, write_report};

}  // namespace kinetix::app
