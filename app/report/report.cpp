#include "app/report/report.hpp"

#include <utility>

#include "app/viewer/assets.hpp"

namespace kinetix::app {
namespace {

// Marks of a page for the script of the three-dimensional view and for the result, in this order (report.hpp).
constexpr std::string_view scene_mark = "@SCENE@";
constexpr std::string_view result_mark = "@RESULT@";

/// Escapes '<', so that the JSON cannot end its script element. In JSON, '<' occurs only within strings.
std::string inert(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json)
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return text;
}

std::string filled(std::string_view page, std::string_view scene, const std::string& json) {
  const std::size_t first = page.find(scene_mark), at = page.find(result_mark);
  std::string text(page.substr(0, first));
  text += scene;
  text += page.substr(first + scene_mark.size(), at - first - scene_mark.size());
  text += inert(json);
  text += page.substr(at + result_mark.size());
  return text;
}

// Text around the result in report.html.
constexpr std::string_view data_start = R"(<script type="application/json" id="result">)";
constexpr std::string_view data_end = "</script>";

/// Returns the index of the result's first character and the index after its last one. Without a result, both are the
/// size of the page.
std::pair<std::size_t, std::size_t> data_range(const std::string& page) {
  const std::size_t before = page.find(data_start);
  if (before == std::string::npos) return {page.size(), page.size()};
  const std::size_t first = before + data_start.size(), end = page.find(data_end, first);
  return {first, end == std::string::npos ? first : end};
}

}  // namespace

std::string data_of_report(const std::string& page) {
  const auto [first, end] = data_range(page);
  return page.substr(first, end - first);
}

std::string report_with(const std::string& page, const std::string& result_json) {
  const auto [first, end] = data_range(page);
  return page.substr(0, first) + inert(result_json) + page.substr(end);
}

std::string report_html(const std::string& result_json) {
  return filled(report_page, scene_script(), result_json);
}

std::string sweep_html(const std::string& sweep_json) { return filled(sweep_page, {}, sweep_json); }

}  // namespace kinetix::app
