#pragma once

#include <string>
#include <string_view>

namespace kinetix::app {

/// One self-contained HTML page that shows a result: no network, no other files.
/// The page copes with missing keys, empty lists and null; text that is no JSON gives a page that says so.
/// @param result_json the content of result.json (kinetix-result/1), UTF-8
std::string report_html(const std::string& result_json);

/// The result that such a page holds, as JSON; empty where the text is no report.
std::string data_of_report(const std::string& page);
/// The page with another result. @pre data_of_report(page) is not empty
std::string report_with(const std::string& page, const std::string& result_json);

/// Likewise of a sweep. @param sweep_json the content of sweep.json (kinetix-sweep/1), UTF-8
std::string sweep_html(const std::string& sweep_json);

/// The report's page with style and scripts in place, @SCENE@ where the three-dimensional view goes and @RESULT@ where the result goes.
extern const std::string_view report_page;
/// That of a sweep, likewise.
extern const std::string_view sweep_page;

}  // namespace kinetix::app
