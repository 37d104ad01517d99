#include "app/exports/report_export.hpp"

#include <nlohmann/json.hpp>

#include "app/report/report.hpp"
#include "app/result/result_json.hpp"

namespace kinetix::app {
namespace {

/// How long it takes to write the page is not known while it is written.
std::vector<NamedContent> write(const Run& run) {
  nlohmann::ordered_json shown = result_json(run);
  shown["timing_s"].erase("write");
  return {{"report.html", report_html(shown.dump())}};
}

}  // namespace

// Name, extensions, whether every run writes it, and how: report.html.
const Exporter report_export = {"report", {"html"}, true, write};

}  // namespace kinetix::app
