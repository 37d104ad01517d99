#include "targets/drawing/svg_style.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <pugixml.hpp>

#include "targets/document/wording.hpp"
#include "targets/drawing/svg_elements.hpp"

namespace kinetix::targets {
namespace {

using Declarations = std::map<std::string, std::string, std::less<>>;

constexpr std::string_view css_spaces = " \t\r\n";

std::string_view trimmed_css(std::string_view text) {
  const std::size_t first = text.find_first_not_of(css_spaces);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(css_spaces) + 1 - first);
}

/// Calls `use` for each part between separators.
template <class Use>
void split_css(std::string_view text, char separator, const Use& use) {
  while (!text.empty()) {
    const std::size_t end = text.find(separator);
    use(trimmed_css(text.substr(0, end)));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
}

Declarations declarations_of(std::string_view text) {
  Declarations values;
  split_css(text, ';', [&](std::string_view part) {
    const std::size_t colon = part.find(':');
    if (colon == std::string_view::npos) return;
    std::string_view value = trimmed_css(part.substr(colon + 1));
    if (const std::size_t mark = value.find('!'); mark != std::string_view::npos)
      value = trimmed_css(value.substr(0, mark));
    values[lower_case(trimmed_css(part.substr(0, colon)))] = std::string(value);
  });
  return values;
}

std::string without_comments(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t start = text.find("/*");
    out += text.substr(0, start);
    if (start == std::string_view::npos) break;
    const std::size_t end = text.find("*/", start + 2);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 2);
  }
  return out;
}

void add_sheets(const pugi::xml_node& node, std::string& text, int depth) {
  constexpr int deepest_sheet = 100;
  if (depth > deepest_sheet) return;
  for (const pugi::xml_node& child : node.children()) {
    if (svg_name(child) == "style")
      for (const pugi::xml_node& part : child.children()) text += part.value();
    else
      add_sheets(child, text, depth + 1);
  }
}

int component(double value) { return static_cast<int>(std::clamp(std::round(value), 0.0, 255.0)); }

/// Reads #RGB and #RRGGBB.
std::optional<int> hex_colour(std::string_view digits) {
  int value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (error != std::errc() || end != digits.data() + digits.size() || value < 0) return std::nullopt;
  if (digits.size() == 6) return value;
  if (digits.size() != 3) return std::nullopt;
  constexpr int doubled = 0x11;  // 0xF becomes 0xFF
  return doubled * (value >> 8) << 16 | doubled * (value >> 4 & 0xF) << 8 | doubled * (value & 0xF);
}

}  // namespace

std::string_view svg_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

std::string_view svg_attribute(const pugi::xml_node& node, std::string_view name) {
  for (const pugi::xml_attribute& attribute : node.attributes()) {
    std::string_view full = attribute.name();
    if (const std::size_t colon = full.find(':'); colon != std::string_view::npos)
      full.remove_prefix(colon + 1);
    if (full == name) return attribute.value();
  }
  return {};
}

SvgStyles::SvgStyles(const pugi::xml_node& svg) {
  std::string text;
  add_sheets(svg, text, 0);
  read_sheet(without_comments(text));
}

void SvgStyles::read_sheet(std::string_view text) {
  for (int rule = 0;; ++rule) {
    const std::size_t open = text.find('{'), close = text.find('}');
    if (open == std::string_view::npos || close == std::string_view::npos) return;
    if (open < close) {
      const Declarations values = declarations_of(text.substr(open + 1, close - open - 1));
      split_css(text.substr(0, open), ',', [&](std::string_view selector) {
        // Selectors of descendants and states match nothing: their rules rarely hide lines.
        for (const auto& [name, value] : values) values_of_[std::string(selector)][name] = {value, rule};
      });
    }
    text.remove_prefix(close + 1);
  }
}

const SvgStyles::Value* SvgStyles::find(const std::string& selector, std::string_view name) const {
  const auto values = values_of_.find(selector);
  if (values == values_of_.end()) return nullptr;
  const auto value = values->second.find(name);
  return value == values->second.end() ? nullptr : &value->second;
}

std::string SvgStyles::property(const pugi::xml_node& node, std::string_view name) const {
  const Declarations inlined = declarations_of(node.attribute("style").value());
  if (const auto found = inlined.find(name); found != inlined.end()) return found->second;
  const std::string element(svg_name(node));
  if (!values_of_.empty()) {
    if (const Value* value = find("#" + std::string(node.attribute("id").value()), name)) return value->text;
    const Value* best = nullptr;
    split_css(node.attribute("class").value(), ' ', [&](std::string_view word) {
      const std::string selector = "." + std::string(word);
      for (const Value* value : {find(selector, name), find(element + selector, name)})
        if (value && (!best || value->rule >= best->rule)) best = value;
    });
    for (const std::string& selector : {element, std::string("*")})
      if (!best) best = find(selector, name);
    if (best) return best->text;
  }
  return node.attribute(std::string(name).c_str()).value();
}

int svg_colour(std::string_view text) {
  static const std::map<std::string_view, int> known = {
      {"red", 0xFF0000},     {"blue", 0x0000FF},  {"green", 0x008000}, {"lime", 0x00FF00},
      {"yellow", 0xFFFF00},  {"cyan", 0x00FFFF},  {"aqua", 0x00FFFF},  {"magenta", 0xFF00FF},
      {"fuchsia", 0xFF00FF}, {"white", 0xFFFFFF}, {"gray", 0x808080},  {"grey", 0x808080}};
  const std::string word = lower_case(text);
  if (word.starts_with('#')) return hex_colour(std::string_view(word).substr(1)).value_or(0);
  if (const auto found = known.find(word); found != known.end()) return found->second;
  if (!word.starts_with("rgb(") || std::count(word.begin(), word.end(), ',') != 2) return 0;
  int colour = 0;
  split_css(std::string_view(word).substr(4, word.size() - 5), ',', [&](std::string_view part) {
    double value = 0;
    std::from_chars(part.data(), part.data() + part.size(), value);
    colour = colour << 8 | component(part.ends_with('%') ? 2.55 * value : value);
  });
  return colour;
}

}  // namespace kinetix::targets
