#include "app/report/report.hpp"

#include <utility>

#include "app/viewer/assets.hpp"

namespace kinetix::app {
namespace {

// Where the page takes the script of the three-dimensional view and the result, in this order (report.hpp).
constexpr std::string_view scene_mark = "@SCENE@";
constexpr std::string_view result_mark = "@RESULT@";

/// JSON that means the same and cannot end its script element: '<' occurs only within strings, where it may
/// be written as an escape.
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

// Around the result in report.html.
constexpr std::string_view data_start = R"(<script type="application/json" id="result">)";
constexpr std::string_view data_end = "</script>";

/// First character of the result and the one behind it; none: both at the end.
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
