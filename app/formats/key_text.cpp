#include "app/formats/key_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "app/io/text_pattern.hpp"

namespace kinetix::app {
namespace {

using Kind = targets::ValueType::Kind;

std::string in_ticks(const std::string& text) { return "`" + text + "`"; }

std::string listed(const std::vector<std::string>& words, const std::string& last_link) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k)
    text += (k == 0 ? "" : k + 1 < words.size() ? ", " : last_link) + in_ticks(words[k]);
  return text;
}

/// "number above 0, in mm"
std::string number_text(const targets::Bounds& bounds) {
  return bounds.describe().substr(std::string("a ").size());
}

std::string length_text(const targets::Bounds& cells) {
  targets::Bounds known;
  if (cells.lower >= 0) known = {.lower = 0, .lower_allowed = cells.lower == 0 && cells.lower_allowed};
  return fmt::format("{}, in {}", number_text(known), cells.unit);
}

std::string integer_text(const targets::Bounds& bounds) {
  if (bounds.lower == bounds.upper) return in_ticks(targets::shortest_text(bounds.lower));
  return "whole " + number_text(bounds);
}

std::string list_text(const targets::ValueType& type) {
  const targets::ValueType& entry = type.parts[0];
  const bool says_more = entry.is_numeric() || entry.kind == Kind::choice;
  return type.form + (says_more ? ", each " + type_text(entry) : "");
}

std::string ways_text(const std::vector<targets::ValueType>& ways) {
  std::string text;
  for (const targets::ValueType& way : ways) {
    const std::string more = type_text(way);
    if (text.find(more) == std::string::npos) text += (text.empty() ? "" : ", or ") + more;
  }
  return text;
}

/// Units and ranges that the type alone would not tell.
std::string unit_text(const targets::ValueType& type) {
  if (type.kind == Kind::list) return unit_text(type.parts[0]);
  return type.is_numeric() && !type.bounds.unit.empty() ? fmt::format(", in {}", type.bounds.unit) : "";
}

std::string unmarked(const std::string& markdown) {
  std::string text = with_matches_replaced(markdown, R"(\[([^\]]*)\]\([^)]*\))", "$1");
  text.erase(std::remove(text.begin(), text.end(), '`'), text.end());
  return text;
}

}  // namespace

std::string type_text(const targets::ValueType& type) {
  switch (type.kind) {
    case Kind::number:
      return type.in_cells ? length_text(type.bounds) : number_text(type.bounds);
    case Kind::angle:
      return number_text(type.bounds);
    case Kind::integer:
      return integer_text(type.bounds);
    case Kind::boolean:
      return "`true` or `false`";
    case Kind::text:
      return type.form;
    case Kind::choice:
      return listed(type.words, " or ");
    case Kind::list:
      return list_text(type);
    case Kind::map:
      return "section";
    case Kind::either:
      break;
  }
  return ways_text(type.parts);
}

std::string default_text(const targets::Key& key, const targets::Alternatives& ways) {
  const bool is_way = std::find(ways.names.begin(), ways.names.end(), key.name) != ways.names.end();
  if (is_way && ways.chosen_by.empty()) return "needed: one of " + listed(ways.names, ", ");
  std::string text = key.fallback.text;
  if (key.fallback.kind == targets::Default::Kind::needed) text = "needed";
  if (key.fallback.kind == targets::Default::Kind::literal) text = in_ticks(text);
  if (key.with.all()) return text;
  std::vector<std::string> with = key.with.names;
  if (!ways.chosen_by.empty())
    for (std::string& word : with) word = ways.chosen_by + ": " + word;
  return fmt::format("{}{}with {}", text, text.empty() ? "" : ", ", listed(with, " or "));
}

std::string plain_text(const targets::Key& key) {
  const std::string rule =
      key.fallback.kind == targets::Default::Kind::described && !key.fallback.text.empty()
          ? "; default: " + key.fallback.text
          : "";
  return unmarked(key.meaning + unit_text(key.type) + rule);
}

std::string anchor(const std::string& heading) {
  std::string text;
  for (const char c : unmarked(heading)) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) || c == '_' || c == '-') text += static_cast<char>(std::tolower(byte));
    if (c == ' ') text += '-';
  }
  return text;
}

}  // namespace kinetix::app
