#include "app/io/text_pattern.hpp"

#include <iterator>
#include <regex>

namespace kinetix::app {
namespace {

using RegexMatch = std::match_results<std::string_view::const_iterator>;

}  // namespace

std::vector<std::string> first_match(std::string_view text, const std::string& pattern) {
  RegexMatch match;
  if (!std::regex_search(text.begin(), text.end(), match, std::regex(pattern))) return {};
  return {match.begin(), match.end()};
}

std::vector<std::string> all_matches(std::string_view text, const std::string& pattern) {
  const std::regex form(pattern);
  std::vector<std::string> out;
  for (std::regex_iterator<std::string_view::const_iterator> k(text.begin(), text.end(), form), end; k != end;
       ++k)
    out.push_back(k->str());
  return out;
}

std::string with_matches_replaced(std::string_view text, const std::string& pattern, const std::string& by) {
  std::string out;
  std::regex_replace(std::back_inserter(out), text.begin(), text.end(), std::regex(pattern), by);
  return out;
}

}  // namespace kinetix::app
