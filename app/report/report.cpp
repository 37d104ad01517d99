#include "app/report/report.hpp"

#include "app/report/page.hpp"

namespace kinetix {
namespace {

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

}  // namespace

std::string report_html(const std::string& result_json) {
  const std::size_t at = report_page.find(result_mark);
  std::string page(report_page.substr(0, at));
  page += inert(result_json);
  page += report_page.substr(at + result_mark.size());
  return page;
}

}  // namespace kinetix
