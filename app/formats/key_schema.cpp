#include "app/formats/key_schema.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/files/bodies_section.hpp"
#include "app/files/design_file.hpp"
#include "app/formats/key_text.hpp"
#include "app/goals/registry.hpp"
#include "app/imports/hinge_choices.hpp"
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

/// A length's bounds follow the cell edge, of which a schema knows nothing but that it is above 0.
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

/// A word that reads as a number is one in the file, unless it stands in quotes.
Json choice_schema(const targets::ValueType& type) {
  Json words = Json::array();
  for (const std::string& word : type.words) {
    const Json number = Json::parse(word, nullptr, false);
    if (number.is_number()) words.push_back(number);
    words.push_back(word);
  }
  return {{"enum", std::move(words)}};
}

Json list_schema(const targets::ValueType& type) {
  Json schema = {{"type", "array"}, {"items", schema_of(type.parts[0])}};
  if (type.shortest > 0) schema["minItems"] = type.shortest;
  if (type.longest != targets::ValueType::any_length) schema["maxItems"] = type.longest;
  return schema;
}

/// A default as the file would say it, where it is a value; else its rule is part of the description.
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
    if (key.fallback.kind == targets::Default::Kind::needed) needed.push_back(key.name);
  return needed;
}

Json plain_map_schema(const targets::KeyTable& keys) {
  Json properties = Json::object();
  for (const targets::Key& key : keys.keys()) properties[key.name] = key_schema(key);
  Json schema = {{"type", "object"}, {"additionalProperties", false}, {"properties", std::move(properties)}};
  if (Json needed = needed_keys(keys); !needed.empty()) schema["required"] = std::move(needed);
  return schema;
}

/// At least one of these keys must be given, too.
Json any_of(const std::vector<std::string>& names) {
  if (names.size() == 1) return Json(names);
  Json schema;
  for (const std::string& name : names) schema["anyOf"].push_back({{"required", Json::array({name})}});
  return schema;
}

/// One of several keys must be given, and others go with one of them alone.
Json map_with_choice_of_keys(const targets::KeyTable& keys) {
  Json schema = plain_map_schema(keys);
  for (const std::string& name : keys.alternatives().names)
    schema["oneOf"].push_back({{"required", Json::array({name})}});
  for (const targets::Key& key : keys.keys())
    if (!key.with.all()) schema["dependencies"][key.name] = any_of(key.with.names);
  return schema;
}

Json map_schema(const targets::KeyTable& keys) {
  const targets::Alternatives& ways = keys.alternatives();
  if (ways.names.empty()) return plain_map_schema(keys);
  if (ways.chosen_by.empty()) return map_with_choice_of_keys(keys);
  Json schema;
  for (const std::string& name : ways.names) schema["anyOf"].push_back(plain_map_schema(keys.only(name)));
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
      return {{"type",
               Json::array({"string", "number", "boolean"})}};  // what is not quoted may read as another type
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
  for (const targets::ValueType& way : type.parts) schema["anyOf"].push_back(schema_of(way));
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

/// `target.kind` says which keys the rest of the file may hold.
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

}  // namespace

std::vector<FileSchema> file_schemas() {
  return {{"target", text_of(of_targets())},
          {"design", text_of(of_one_table("A design for kinetix-opt: design.yaml", design_keys()))},
          {"assembly", text_of(of_one_table("A design of general bodies for kinetix-opt", bodies_keys()))},
          {"hinges", text_of(of_one_table("Axes of hinges for kinetix-opt import", hinge_choice_keys()))},
          {"doe", text_of(of_one_table("A sweep of kinetix-opt: doe.yaml", doe_keys()))}};
}

}  // namespace kinetix::app
