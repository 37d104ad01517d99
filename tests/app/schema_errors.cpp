#include "tests/app/schema_errors.hpp"

#include <set>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>
#include <vector>

#include "tests/app/program.hpp"

namespace kinetix::testing {
namespace {

using Json = nlohmann::json;
using Schemas = std::vector<const Json*>;

/// Keys of a document that no part of its schema names, as "a.b[].c".
class UnnamedKeys {
 public:
  explicit UnnamedKeys(const Json& root) : root_(root) {}

  std::set<std::string> of(const Json& document) {
    visit(document, {&root_}, "");
    return found_;
  }

 private:
  /// Adds a schema, the schemas that it refers to, and its alternatives.
  void add_alternatives(const Json& schema, Schemas& alternatives) const {
    alternatives.push_back(&schema);
    if (schema.contains("$ref"))
      add_alternatives(root_.at(Json::json_pointer(schema["$ref"].get<std::string>().substr(1))),
                       alternatives);
    for (const char* several : {"oneOf", "anyOf", "allOf"})
      if (schema.contains(several))
        for (const Json& alternative : schema[several]) add_alternatives(alternative, alternatives);
    if (schema.contains("then")) add_alternatives(schema["then"], alternatives);
  }

  /// Checks that the object has the values that the schema fixes: a target's `kind` selects its keys.
  static bool fits(const Json& schema, const Json& object) {
    if (!schema.contains("properties")) return true;
    for (const auto& [key, value] : schema["properties"].items())
      if (value.contains("const") && object.contains(key) && object[key] != value["const"]) return false;
    return true;
  }

  static Schemas naming(const std::string& key, const Json& object, const Schemas& alternatives) {
    Schemas named, free;
    for (const Json* alternative : alternatives) {
      if (!fits(*alternative, object)) continue;
      if (alternative->contains("properties") && (*alternative)["properties"].contains(key))
        named.push_back(&(*alternative)["properties"][key]);
      if (alternative->contains("additionalProperties") && (*alternative)["additionalProperties"].is_object())
        free.push_back(&(*alternative)["additionalProperties"]);
    }
    return named.empty() ? free : named;
  }

  void visit(const Json& value, const Schemas& schemas, const std::string& path) {
    Schemas alternatives, items;
    for (const Json* schema : schemas) add_alternatives(*schema, alternatives);
    if (value.is_object())
      for (const auto& [key, inner] : value.items())
        visit_key(path + key, inner, naming(key, value, alternatives));
    for (const Json* alternative : alternatives)
      if (alternative->contains("items")) items.push_back(&(*alternative)["items"]);
    if (value.is_array())
      for (const Json& entry : value) visit(entry, items, path.substr(0, path.size() - 1) + "[].");
  }

  void visit_key(const std::string& path, const Json& value, const Schemas& named) {
    if (named.empty())
      found_.insert(path);
    else
      visit(value, named, path + ".");
  }

  const Json& root_;
  std::set<std::string> found_;
};

std::string not_allowed(const Json& document, const Json& schema_json) {
  valijson::Schema schema;
  valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_json), schema);
  valijson::ValidationResults errors;
  valijson::Validator().validate(schema, valijson::adapters::NlohmannJsonAdapter(document), &errors);
  std::string text;
  for (const auto& error : errors) {
    for (const auto& part : error.context) text += part;
    text += ": " + error.description + "\n";
  }
  return text;
}

}  // namespace

std::string schema_errors(const Json& document, const std::string& name) {
  const Json schema = Json::parse(text_of(KINETIX_SOURCE "/app/schema/" + name + ".schema.json"));
  std::string text = not_allowed(document, schema);
  for (const std::string& key : UnnamedKeys(schema).of(document))
    text += key + ": the schema names no such key\n";
  return text;
}

std::string false_flags(const Json& result) {
  std::string flags;
  for (const auto& [name, flag] : result["verdict"].items())
    if (flag == false) flags += (flags.empty() ? "" : ", ") + name;
  return flags;
}

}  // namespace kinetix::testing
