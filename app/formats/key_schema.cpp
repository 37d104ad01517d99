#include "app/formats/formats_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <cctype>
#include <nlohmann/json.hpp>
#include <regex>

#include "app/files/bodies_section.hpp"
#include "app/files/design_file.hpp"
#include "app/goals/registry.hpp"
#include "app/imports/model_parts.hpp"
#include "app/io/text_pattern.hpp"
#include "app/sweep/plan/doe_file.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;
using Kind = targets::ValueType::Kind;

Json schema_of(const targets::ValueType& type);

void add_bounds(Json& schema, const targets::Bounds& bounds) {
  const auto number = [](double x) { return x == std::trunc(x) ? Json(static_cast<long>(x)) : Json(x); };
  if (std::isfinite(bounds.lower))
    schema[bounds.lower_allowed ? "minimum" : "exclusiveMinimum"] = number(bounds.lower);
  if (std::isfinite(bounds.upper))
    schema[bounds.upper_allowed ? "maximum" : "exclusiveMaximum"] = number(bounds.upper);
}

/// Returns the bounds of a length that hold for every cell edge: a schema only knows that the edge is above 0.
targets::Bounds fixed_part(const targets::Bounds& cells) {
  if (cells.lower < 0) return {};
  return cells.lower > 0 ? targets::above(0)
                         : targets::Bounds{.lower = 0, .lower_allowed = cells.lower_allowed};
}

Json number_schema(const targets::ValueType& type) {
  Json schema = {{"type", type.kind == Kind::integer ? "integer" : "number"}};
  add_bounds(schema, type.in_cells ? fixed_part(type.bounds) : type.bounds);
  return schema;
}

/// Returns the schema of a choice. A word that reads as a number is a number in the file, unless it is quoted.
Json choice_schema(const targets::ValueType& type) {
  Json words = Json::array(), old_words = Json::array();
  for (const std::string& word : type.words) {
    const Json number = Json::parse(word, nullptr, false);
    if (number.is_number()) words.push_back(number);
    words.push_back(word);
  }
  Json schema = {{"enum", std::move(words)}};
  if (type.old_words.empty()) return schema;
  for (const auto& [word, replacement] : type.old_words) old_words.push_back(word);
  Json old = {{"enum", std::move(old_words)}, {"deprecated", true}};
  return {{"anyOf", Json::array({std::move(schema), std::move(old)})}};
}

Json list_schema(const targets::ValueType& type) {
  Json schema = {{"type", "array"}, {"items", schema_of(type.parts[0])}};
  if (type.shortest > 0) schema["minItems"] = type.shortest;
  if (type.longest != targets::ValueType::any_length) schema["maxItems"] = type.longest;
  return schema;
}

/// Returns a default as the file would write it, if it is a value. Otherwise its rule is part of the description.
Json default_value(const targets::Default& fallback) {
  const Json value = Json::parse(fallback.text, nullptr, false);
  return value.is_discarded() ? Json(fallback.text) : value;
}

Json key_schema(const targets::Key& key) {
  Json schema = {{"description", plain_text(key)}};
  schema.update(schema_of(key.type));
  if (key.fallback.kind == targets::Default::Kind::literal) schema["default"] = default_value(key.fallback);
  return schema;
}

Json needed_keys(const targets::KeyTable& keys) {
  Json needed = Json::array();
  for (const targets::Key& key : keys.keys())
    if (key.fallback.kind == targets::Default::Kind::needed && key.old_name.empty())
      needed.push_back(key.name);
  return needed;
}

/// Allows a key under one of its two names only. @pre it has an earlier name
Json one_name(const targets::Key& key) {
  const auto required = [](std::initializer_list<std::string> names) -> Json {
    return {{"required", Json(std::vector<std::string>(names))}};
  };
  if (key.fallback.kind == targets::Default::Kind::needed)
    return {{"oneOf", Json::array({required({key.name}), required({key.old_name})})}};
  return {{"not", required({key.name, key.old_name})}};
}

Json plain_map_schema(const targets::KeyTable& keys) {
  Json properties = Json::object();
  for (const targets::Key& key : keys.keys()) properties[key.name] = key_schema(key);
  for (const targets::Key& key : keys.keys()) {
    if (key.old_name.empty()) continue;
    Json& old = properties[key.old_name] = key_schema(key);
    old["description"] = fmt::format("earlier name of {}", key.name);
    old["deprecated"] = true;
  }
  Json schema = {{"type", "object"}, {"additionalProperties", false}, {"properties", std::move(properties)}};
  if (Json needed = needed_keys(keys); !needed.empty()) schema["required"] = std::move(needed);
  for (const targets::Key& key : keys.keys())
    if (!key.old_name.empty()) schema["allOf"].push_back(one_name(key));
  return schema;
}

/// Requires at least one of these keys.
Json any_of(const std::vector<std::string>& names) {
  if (names.size() == 1) return Json(names);
  Json schema;
  for (const std::string& name : names) schema["anyOf"].push_back({{"required", Json::array({name})}});
  return schema;
}

/// Requires one of several keys. Some other keys are allowed only with certain ones of these.
Json map_with_choice_of_keys(const targets::KeyTable& keys) {
  Json schema = plain_map_schema(keys);
  for (const std::string& name : keys.alternatives().names)
    schema["oneOf"].push_back({{"required", Json::array({name})}});
  for (const targets::Key& key : keys.keys())
    if (!key.with.all()) schema["dependencies"][key.name] = any_of(key.with.names);
  return schema;
}

Json map_schema(const targets::KeyTable& keys) {
  const targets::Alternatives& alternatives = keys.alternatives();
  if (alternatives.names.empty()) return plain_map_schema(keys);
  if (alternatives.chosen_by.empty()) return map_with_choice_of_keys(keys);
  Json schema;
  for (const std::string& name : alternatives.names)
    schema["anyOf"].push_back(plain_map_schema(keys.only(name)));
  return schema;
}

Json schema_of(const targets::ValueType& type) {
  switch (type.kind) {
    case Kind::number:
    case Kind::angle:
    case Kind::integer:
      return number_schema(type);
    case Kind::boolean:
      return {{"type", "boolean"}};
    case Kind::text:
      return {{"type", Json::array({"string", "number", "boolean"})}};  // unquoted text may have another type
    case Kind::choice:
      return choice_schema(type);
    case Kind::list:
      return list_schema(type);
    case Kind::map:
      return map_schema(*type.keys);
    case Kind::either:
      break;
  }
  Json schema;
  for (const targets::ValueType& alternative : type.parts) schema["anyOf"].push_back(schema_of(alternative));
  return schema;
}

Json header(const std::string& title) {
  return {{"$schema", "http://json-schema.org/draft-07/schema#"},
          {"title", title},
          {"description", "Made by kinetix-formats from the tables by which the program reads the file."}};
}

Json of_one_table(const std::string& title, const targets::KeyTable& keys) {
  Json schema = header(title);
  schema.update(map_schema(keys));
  return schema;
}

/// Returns the schema of targets: `target.kind` selects the keys that the rest of the file may hold.
Json of_targets() {
  Json schema = header("A goal for kinetix-opt: target.yaml"), kinds = Json::array();
  for (const GoalKind* kind : goal_kinds()) {
    kinds.push_back(kind->name);
    const Json is_kind = {{"properties", {{"kind", {{"const", kind->name}}}}},
                          {"required", Json::array({"kind"})}};
    schema["allOf"].push_back(
        {{"if", {{"properties", {{"target", is_kind}}}, {"required", Json::array({"target"})}}},
         {"then", {{"$ref", "#/definitions/" + std::string(kind->name)}}}});
    schema["definitions"][std::string(kind->name)] = map_schema(kind->table());
  }
  schema["type"] = "object";
  schema["required"] = Json::array({"kinetix", "target"});
  schema["properties"]["target"] = {
      {"type", "object"}, {"required", Json::array({"kind"})}, {"properties", {{"kind", {{"enum", kinds}}}}}};
  return schema;
}

std::string text_of(const Json& schema) { return schema.dump(1) + "\n"; }

std::string in_ticks(const std::string& text) { return "`" + text + "`"; }

std::string listed(const std::vector<std::string>& words, const std::string& last_link) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k)
    text += (k == 0 ? "" : k + 1 < words.size() ? ", " : last_link) + in_ticks(words[k]);
  return text;
}

/// Describes the bounds of a number: "number above 0, in mm".
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
  const bool is_detailed = entry.is_numeric() || entry.kind == Kind::choice;
  return type.form + (is_detailed ? ", each " + type_text(entry) : "");
}

std::string alternatives_text(const std::vector<targets::ValueType>& alternatives) {
  std::string text;
  for (const targets::ValueType& alternative : alternatives) {
    const std::string more = type_text(alternative);
    if (text.find(more) == std::string::npos) text += (text.empty() ? "" : ", or ") + more;
  }
  return text;
}

/// Returns the unit, which the type alone does not show.
std::string unit_text(const targets::ValueType& type) {
  if (type.kind == Kind::list) return unit_text(type.parts[0]);
  return type.is_numeric() && !type.bounds.unit.empty() ? fmt::format(", in {}", type.bounds.unit) : "";
}

std::string unmarked(const std::string& markdown) {
  std::string text = with_matches_replaced(markdown, R"(\[([^\]]*)\]\([^)]*\))", "$1");
  text.erase(std::remove(text.begin(), text.end(), '`'), text.end());
  return text;
}

/// Rounds long decimals of a default to 4 digits: angles that come from radians have more.
std::string round_decimals(const std::string& text) {
  static const std::regex decimals("[0-9]+[.][0-9]{6,}");
  std::string rounded;
  std::size_t done = 0;
  for (std::sregex_iterator at(text.begin(), text.end(), decimals), end; at != end; ++at) {
    const auto start = static_cast<std::size_t>(at->position());
    rounded += text.substr(done, start - done) + fmt::format("{:.4g}", std::stod(at->str()));
    done = start + static_cast<std::size_t>(at->length());
  }
  return rounded + text.substr(done);
}

}  // namespace

std::vector<FileSchema> file_schemas() {
  return {{"target", text_of(of_targets())},
          {"design", text_of(of_one_table("A design for kinetix-opt: design.yaml", design_keys()))},
          {"assembly", text_of(of_one_table("A design of general bodies for kinetix-opt", bodies_keys()))},
          {"hinges", text_of(of_one_table("Axes of hinges for kinetix-opt import", hinge_choice_keys()))},
          {"doe", text_of(of_one_table("A sweep of kinetix-opt: doe.yaml", doe_keys()))}};
}

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
  return alternatives_text(type.parts);
}

std::string default_text(const targets::Key& key, const targets::Alternatives& alternatives) {
  const bool is_alternative_key =
      std::find(alternatives.names.begin(), alternatives.names.end(), key.name) != alternatives.names.end();
  if (is_alternative_key && alternatives.chosen_by.empty())
    return "needed: one of " + listed(alternatives.names, ", ");
  std::string text = key.fallback.text;
  if (key.fallback.kind == targets::Default::Kind::needed) text = "needed";
  if (key.fallback.kind == targets::Default::Kind::literal) text = in_ticks(round_decimals(text));
  if (key.with.all()) return text;
  std::vector<std::string> with = key.with.names;
  if (!alternatives.chosen_by.empty())
    for (std::string& word : with) word = alternatives.chosen_by + ": " + word;
  return fmt::format("{}{}with {}", text, text.empty() ? "" : ", ", listed(with, " or "));
}

std::string plain_text(const targets::Key& key) {
  const std::string rule =
      key.fallback.kind == targets::Default::Kind::described && !key.fallback.text.empty()
          ? "; default: " + key.fallback.text
          : "";
  return unmarked(key.meaning + unit_text(key.type) + rule);
}

std::string meaning_text(const targets::Key& key) {
  std::string text = key.meaning;
  if (!key.old_name.empty()) text += fmt::format(" (earlier name: `{}`)", key.old_name);
  for (const auto& [word, replacement] : key.type.old_words)
    text += fmt::format(" (earlier word for `{}`: `{}`)", replacement, word);
  return text;
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
