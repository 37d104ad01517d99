#include "app/report/report.hpp"

#include "app/report/page.hpp"

namespace kinetix::app {
namespace {

constexpr std::string_view result_mark = "@RESULT@";  // where the page takes the result (page.hpp)

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

std::string filled(std::string_view page, const std::string& json) {
  const std::size_t at = page.find(result_mark);
  std::string text(page.substr(0, at));
  text += inert(json);
  text += page.substr(at + result_mark.size());
  return text;
}

}  // namespace

std::string report_html(const std::string& result_json) { return filled(report_page, result_json); }

std::string sweep_html(const std::string& sweep_json) { return filled(sweep_page, sweep_json); }

}  // namespace kinetix::app
