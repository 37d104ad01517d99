#include <gtest/gtest.h>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "app/report/report.hpp"

namespace kinetix::app {
namespace {

// Tags around the result in the page.
const std::string data_start = R"(<script type="application/json" id="result">)";
const std::string script_end = "</script>";

std::string sample() {
  std::ifstream file(SAMPLE_RESULT);
  EXPECT_TRUE(file) << SAMPLE_RESULT;
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Returns the data as a browser reads it: up to the first end tag.
std::string data_of(const std::string& page) {
  const std::size_t from = page.find(data_start) + data_start.size();
  return page.substr(from, page.find(script_end, from) - from);
}

int occurrences(const std::string& text, const std::string& part) {
  int n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

TEST(Report, HoldsTheWholeResult) {
  EXPECT_EQ(nlohmann::json::parse(data_of(report_html(sample()))), nlohmann::json::parse(sample()));
}

TEST(Report, RefersToNothingOutsideItself) {
  const std::string page = report_html("{}");
  for (const char* pattern : {R"(\b(src|href)\s*=\s*["'])", R"(<link)", R"(@import)", R"(\burl\((?!#))",
                              R"(\bimport\b)", R"(\bfetch\()", R"(XMLHttpRequest)"})
    EXPECT_FALSE(std::regex_search(page, std::regex(pattern, std::regex::icase))) << pattern;
  // The addresses left are the names of the namespaces of SVG and HTML.
  EXPECT_EQ(occurrences(page, "http://"), occurrences(page, "http://www.w3.org/2000/svg") +
                                              occurrences(page, "http://www.w3.org/1999/xhtml"));
  EXPECT_EQ(occurrences(page, "https://"), 0);
}

TEST(Report, KeepsMarkupInTheDataInert) {
  const nlohmann::json result = {{"name", "</script><script>alert(1)</script> <!-- <script> ]]> @RESULT@"}};
  const std::string page = report_html(result.dump());
  EXPECT_EQ(nlohmann::json::parse(data_of(page)), result);
  EXPECT_EQ(occurrences(page, "<script"), 3);
  EXPECT_EQ(occurrences(page, "</script"), 3);
  EXPECT_EQ(page.find("<!--"), std::string::npos);
}

/// All scripts share one scope: the later of two functions would silently take the place of the other.
TEST(Report, NamesEveryFunctionOnce) {
  const std::string page = report_html("{}");
  const std::regex function("\nfunction (\\w+)\\(");
  std::map<std::string, int> named;
  for (auto at = std::sregex_iterator(page.begin(), page.end(), function); at != std::sregex_iterator(); ++at)
    ++named[(*at)[1]];
  EXPECT_GT(named.size(), 100u);
  for (const auto& [name, times] : named) EXPECT_EQ(times, 1) << name;
}

TEST(Report, LeavesNoPlaceholder) {
  const std::string page = report_html("{}");
  EXPECT_FALSE(std::regex_search(page, std::regex("@[A-Z_]+@")));
}

TEST(Report, AddsABoundedAmountToTheResult) {
  EXPECT_LT(report_html("{}").size(), 740'000u);
  const std::string result = sample();
  EXPECT_LT(report_html(result).size(), report_html("{}").size() + result.size() + 1000);
}

TEST(Report, TakesWhatIsNoJson) {
  EXPECT_EQ(data_of(report_html("")), "");
  EXPECT_EQ(data_of(report_html("NaN <")), "NaN \\u003c");
}

TEST(Report, TakesAnotherResult) {
  const std::string page = report_html(R"({"name": "a", "note": "<b>"})");
  EXPECT_EQ(data_of_report(page), data_of(page));
  const std::string other = report_with(page, R"({"name": "</script>"})");
  EXPECT_EQ(other, report_html(R"({"name": "</script>"})"));
  EXPECT_EQ(data_of_report("no page"), "");
}

TEST(RoundNumbers, WritesWholeOnesWithoutAPoint) {
  nlohmann::ordered_json numbers = {150.0, -3.0000000001, 0.123456789, -0.0, 1e20, "1.0", 7};
  round_numbers(numbers, 6);
  EXPECT_EQ(numbers.dump(), R"([150,-3,0.123457,0,1e+20,"1.0",7])");
}

}  // namespace
}  // namespace kinetix::app
