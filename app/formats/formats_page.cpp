#include "app/formats/formats_page.hpp"

#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "app/files/bodies_section.hpp"
#include "app/files/design_file.hpp"
#include "app/files/process_section.hpp"
#include "app/goals/registry.hpp"
#include "app/imports/model_parts.hpp"
#include "app/sweep/plan/doe_file.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

std::string choices_text(const Json& words) {
  std::string text;
  for (const Json& word : words)
    text += (text.empty() ? "`" : ", `") + (word.is_string() ? word.get<std::string>() : word.dump()) + "`";
  return text;
}

/// Formats the bounds of a schema: " above 0", " at least 1".
std::string bounds_text(const Json& schema) {
  // Keys of JSON Schema, and their words for a range.
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
    return "| key | type | meaning |\n|---|---|---|\n" + rows_;
  }

 private:
  /// Returns the schema that a reference names, with the keys next to the reference.
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
    if (schema.contains("const")) return choices_text(Json::array({schema["const"]}));
    if (schema.contains("enum")) return choices_text(schema["enum"]);
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

  /// Adds a row for each key of a schema. @param note goes before every meaning
  void add_properties(const std::string& prefix, const Json& schema, const std::string& note = {}) {
    const Json properties = schema.value("properties", Json::object());
    for (const auto& [key, value] : properties.items()) add_key(prefix + key, resolved(value), note);
    for (const Json& alternative : schema.value("oneOf", Json::array()))
      if (alternative.contains("properties"))
        add_properties(prefix, alternative,
                       alternative["properties"]["kind"]["const"].get<std::string>() + ": ");
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

/// Returns the keys of a JSON document as a Markdown table: path, type with its range, meaning.
/// @param schema JSON Schema (draft 07) with `$ref` to its own definitions alone
/// @throws InvalidInput for a key without a description
std::string schema_table(const std::string& schema) { return SchemaTable(Json::parse(schema)).text(); }

using Kind = targets::ValueType::Kind;

/// Rows of one table. Equal rows of a map's alternatives appear once.
struct Rows {
  std::string text;
  std::set<std::string> said;  ///< rows added; for choices their path and the names they go with
  std::map<std::string, std::vector<std::string>> words = {};  ///< of choices, from all alternatives of a map
};

void add_map(Rows& rows, const std::string& prefix, const targets::KeyTable& keys);

std::string meaning_of(const std::string& path, const targets::Key& key) {
  if (key.meaning.empty()) throw InvalidInput("the key `" + path + "` has no documentation");
  return meaning_text(key);
}

/// Collects the words of each choice from all alternatives of a map: the page shows them all.
void add_choices(Rows& rows, const std::string& prefix, const std::vector<targets::ValueType>& alternatives) {
  for (const targets::ValueType& alternative : alternatives) {
    if (alternative.kind != Kind::map) continue;
    for (const targets::Key& key : alternative.keys->keys()) {
      if (key.type.kind != Kind::choice) continue;
      std::vector<std::string>& words = rows.words[prefix + key.name];
      for (const std::string& word : key.type.words)
        if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
    }
  }
}

/// Adds the maps that a value may hold. Their paths include what is between the key and theirs.
void add_inner_maps(Rows& rows, const std::string& path, const targets::ValueType& type) {
  if (type.kind == Kind::map && type.keys->title().empty()) add_map(rows, path + ".", *type.keys);
  if (type.kind == Kind::either) add_choices(rows, path + ".", type.parts);
  for (const targets::ValueType& part : type.parts)
    add_inner_maps(rows, type.kind == Kind::list ? path + "[]" : path, part);
}

/// Adds links to the sections that list the keys of shared maps.
void add_links_to_shared(std::string& text, const targets::ValueType& type) {
  if (type.kind == Kind::map && !type.keys->title().empty())
    text += fmt::format(", [its keys](#{})", anchor(type.keys->title()));
  if (type.kind == Kind::either)
    for (const targets::ValueType& part : type.parts) add_links_to_shared(text, part);
}

std::string linked_type(const Rows& rows, const std::string& path, targets::ValueType type) {
  if (const auto words = rows.words.find(path); words != rows.words.end() && type.kind == Kind::choice)
    type.words = words->second;
  std::string text = type_text(type);
  add_links_to_shared(text, type);
  return text;
}

void add_map(Rows& rows, const std::string& prefix, const targets::KeyTable& keys) {
  for (const targets::Key& key : keys.keys()) {
    const std::string path = prefix + key.name,
                      row = fmt::format("| `{}` | {} | {} | {} |\n", path, linked_type(rows, path, key.type),
                                        default_text(key, keys.alternatives()), meaning_of(path, key)),
                      choice = fmt::format("{} {}", path, fmt::join(key.with.names, " "));
    if (rows.said.insert(key.type.kind == Kind::choice ? choice : row).second) rows.text += row;
    add_inner_maps(rows, path, key.type);
  }
}

std::string key_table(const targets::KeyTable& keys) {
  Rows rows{.text = "| key | type and range | default | meaning |\n|---|---|---|---|\n", .said = {}};
  const std::string prefix =
      keys.title().empty() ? "" : keys.title().substr(keys.title().find(' ') + 1) + ".";
  add_map(rows, prefix, keys);
  return rows.text;
}

std::string metrics_table() {
  std::string text = "| metric | kind | unit | meaning |\n|---|---|---|---|\n";
  for (const GoalKind* kind : goal_kinds())
    for (const GoalMetric& metric : kind->metrics) {
      if (metric.meaning.empty())
        throw InvalidInput(fmt::format("the metric `{}` has no documentation", metric.name));
      text += fmt::format("| `{}` | {} | {} | {} |\n", metric.name, kind->name, metric.unit, metric.meaning);
    }
  return text;
}

/// Returns the anchors of a page's headings.
std::set<std::string> anchors_of(const std::string& page) {
  std::set<std::string> anchors;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("#")) anchors.insert(anchor(line.substr(line.find_first_not_of("# "))));
  return anchors;
}

class PageTemplate {
 public:
  explicit PageTemplate(SchemaText schema) : schema_(schema) {}

  std::vector<FormatsPage> filled(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      const bool is_mark = line.starts_with("{{") && line.ends_with("}}");
      const std::string mark = is_mark ? line.substr(2, line.size() - 4) : "";
      if (mark.starts_with("page "))
        pages_.push_back({.name = mark.substr(5), .text = {}});
      else if (pages_.empty())
        throw InvalidInput("the template of formats has text before its first {{page NAME}}");
      else
        pages_.back().text += is_mark ? table(mark) : line + "\n";
    }
    if (!unused_.empty()) throw InvalidInput("the pages of formats lack {{keys " + *unused_.begin() + "}}");
    link_pages();
    return std::move(pages_);
  }

 private:
  static std::set<std::string> names_of_lists() {
    std::set<std::string> names;
    for (const KeyList& list : all_keys()) names.insert(list.name);
    return names;
  }

  std::string table(const std::string& mark) {
    if (mark == "metrics") return metrics_table();
    if (mark.starts_with("json ")) return schema_table(schema_(mark.substr(5)));
    for (const KeyList& list : all_keys())
      if (mark == "keys " + list.name) {
        unused_.erase(list.name);
        return key_table(*list.keys);
      }
    throw InvalidInput("the template of formats has the mark {{" + mark + "}}, which stands for nothing");
  }

  /// Puts the name of the page before each anchor of another page: tables and prose name headings alone.
  void link_pages() {
    std::map<std::string, std::string> page_of;
    for (const FormatsPage& page : pages_)
      for (const std::string& name : anchors_of(page.text)) page_of.emplace(name, page.name);
    for (FormatsPage& page : pages_) {
      const std::set<std::string> here = anchors_of(page.text);
      for (std::size_t at = 0; (at = page.text.find("](#", at)) != std::string::npos; at += 3) {
        const std::size_t begin = at + 3;
        const std::string name = page.text.substr(begin, page.text.find(')', begin) - begin);
        if (here.contains(name)) continue;
        const auto found = page_of.find(name);
        if (found == page_of.end())
          throw InvalidInput("a page of formats links to #" + name + ", which no page has");
        page.text.insert(at + 2, found->second);
      }
    }
  }

  SchemaText schema_;
  std::vector<FormatsPage> pages_;
  std::set<std::string> unused_ = names_of_lists();
};

}  // namespace

std::vector<FormatsPage> formats_pages(const std::string& text, SchemaText schema) {
  return PageTemplate(schema).filled(text);
}

std::vector<KeyList> all_keys() {
  std::vector<KeyList> lists;
  for (const GoalKind* kind : goal_kinds())
    lists.push_back({"target " + std::string(kind->name), &kind->table()});
  lists.push_back({"design", &design_keys()});
  lists.push_back({"assembly", &bodies_keys()});
  lists.push_back({"hinges", &hinge_choice_keys()});
  lists.push_back({"doe", &doe_keys()});
  for (const targets::KeyTable* shared : {&hinge_keys(), &process_keys(), &physics_keys()})
    lists.push_back({shared->title(), shared});
  return lists;
}

}  // namespace kinetix::app
