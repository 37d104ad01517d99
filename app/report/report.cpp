#include "app/report/report.hpp"

#include "app/report/page.hpp"
#include "app/viewer/assets.hpp"

namespace kinetix::app {
namespace {

// Where the page takes the script of the three-dimensional view and the result, in this order (page.hpp).
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

}  // namespace

std::string report_html(const std::string& result_json) {
  return filled(report_page, scene_script(), result_json);
}

std::string sweep_html(const std::string& sweep_json) { return filled(sweep_page, {}, sweep_json); }

}  // namespace kinetix::app
