#pragma once

#include <string>
#include <string_view>

namespace kinetix::app {

/// Makes one self-contained HTML page that shows a result, without network or other files.
/// The page accepts missing keys, empty lists and null. For text that is not JSON it shows an error.
/// @param result_json the content of result.json (kinetix-result/1), UTF-8
std::string report_html(const std::string& result_json);

/// Returns the result inside a report page, as JSON. Empty if the text is not a report.
std::string data_of_report(const std::string& page);
/// Returns the page with another result. @pre data_of_report(page) is not empty
std::string report_with(const std::string& page, const std::string& result_json);

/// Makes one self-contained HTML page that shows a sweep. @param sweep_json sweep.json (kinetix-sweep/1), UTF-8
std::string sweep_html(const std::string& sweep_json);

/// Report page with style and scripts. @SCENE@ stands for the script of the 3D view, @RESULT@ for the result.
extern const std::string_view report_page;
/// Sweep page with style and scripts, @SCENE@ and @RESULT@. Its @SCENE@ is replaced by an empty text.
extern const std::string_view sweep_page;

}  // namespace kinetix::app
