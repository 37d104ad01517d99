#include "app/formats/schema_table.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "model/base/invalid_input.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

std::string words_text(const Json& words) {
  std::string text;
  for (const Json& word : words)
    text += (text.empty() ? "`" : ", `") + (word.is_string() ? word.get<std::string>() : word.dump()) + "`";
  return text;
}

/// " above 0", " from 1"
std::string bounds_text(const Json& schema) {
  // Keys of JSON Schema, and how a range is told in words.
  static constexpr std::pair<const char*, const char*> bounds[] = {{"minimum", "at least"},
                                                                   {"exclusiveMinimum", "above"},
                                                                   {"maximum", "at most"},
                                                                   {"exclusiveMaximum", "below"}};
  std::string text;
  for (const auto& [key, words] : bounds)
    if (schema.contains(key))
      text += fmt::format("{} {} {}", text.empty() ? "" : ",", words, schema[key].dump());
  return text;
}

class SchemaTable {
 public:
  explicit SchemaTable(Json root) : root_(std::move(root)) {}

  std::string text() {
    add_properties("", root_);
    return "| key | what it is | meaning |\n|---|---|---|\n" + rows_;
  }

 private:
  /// The schema that a reference names, with the keys that stand beside the reference.
  Json resolved(const Json& schema) const {
    if (!schema.contains("$ref")) return schema;
    Json full = root_.at(Json::json_pointer(schema["$ref"].get<std::string>().substr(1)));
    for (const auto& [key, value] : schema.items())
      if (key != "$ref") full[key] = value;
    return full;
  }

  std::string list_text(const Json& schema) const {
    const std::string entry = schema.contains("items") ? type_text(resolved(schema["items"])) : "values";
    const int least = schema.value("minItems", 0), most = schema.value("maxItems", -1);
    if (least == most) return fmt::format("list of {}: {}", least, entry);
    return fmt::format("list of {}{}", least > 0 ? fmt::format("at least {}: ", least) : "", entry);
  }

  std::string type_text(const Json& schema) const {
    if (schema.contains("const")) return words_text(Json::array({schema["const"]}));
    if (schema.contains("enum")) return words_text(schema["enum"]);
    if (schema.contains("oneOf") && !schema.contains("properties")) return "section or nothing";
    const Json type = schema.value("type", Json("section"));
    if (type.is_array()) {
      std::string text;
      for (const Json& name : type) text += (text.empty() ? "" : " or ") + name.get<std::string>();
      return text;
    }
    if (type == "array") return list_text(schema);
    return (type == "object" ? "section" : type.get<std::string>()) + bounds_text(schema);
  }

  /// @param note goes before every meaning
  void add_properties(const std::string& prefix, const Json& schema, const std::string& note = {}) {
    const Json properties = schema.value("properties", Json::object());
    for (const auto& [key, value] : properties.items()) add_key(prefix + key, resolved(value), note);
    for (const Json& way : schema.value("oneOf", Json::array()))
      if (way.contains("properties"))
        add_properties(prefix, way, way["properties"]["kind"]["const"].get<std::string>() + ": ");
  }

  void add_key(const std::string& path, const Json& schema, const std::string& note) {
    const std::string meaning = schema.value("description", "");
    if (meaning.empty()) throw InvalidInput("the key `" + path + "` of a schema has no description");
    rows_ += fmt::format("| `{}` | {} | {}{} |\n", path, type_text(schema), note, meaning);
    add_inner(path, schema, note);
  }

  void add_inner(const std::string& path, const Json& schema, const std::string& note) {
    if (schema.contains("items"))
      add_inner(path + "[]", resolved(schema["items"]), note);
    else
      add_properties(path + ".", schema, note);
  }

  Json root_;
  std::string rows_;
};

}  // namespace

std::string schema_table(const std::string& schema) { return SchemaTable(Json::parse(schema)).text(); }

}  // namespace kinetix::app
