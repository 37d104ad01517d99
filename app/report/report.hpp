#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace kinetix::app {

/// Reduces a result to a third of its size for a page.
///
/// Numbers have six digits. Poses become `rows` of seven numbers: x, y, z in mm to 0.0001, then the quaternion w, x, y,
/// z to 1e-6. Frames are removed if the page computes them (`has_scene`, and an exact family). Otherwise as many frames
/// remain as fit into 60 kB. Data that no page reads is removed.
nlohmann::ordered_json compact_result(nlohmann::ordered_json result, bool has_scene);

/// Returns whole numbers as integers, which print without ".0". A script reads the same number.
nlohmann::ordered_json short_number(double x);

/// Rounds every number that is not an integer to `digits` significant digits. Numbers below 1e-15 become 0.
void round_numbers(nlohmann::ordered_json& value, int digits);

/// Number of factors per response that the page plots.
inline constexpr int plotted_factors = 6;  // two rows of three

/// Reduces a sweep for its page. Numbers have five digits. Each response gets `plotted`, the factors with the largest
/// effect on it. Levels and dots of factors that are not plotted are removed.
nlohmann::ordered_json compact_sweep(nlohmann::ordered_json sweep);

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
