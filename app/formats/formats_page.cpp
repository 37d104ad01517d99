#include "app/formats/formats_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "app/formats/all_keys.hpp"
#include "app/formats/key_text.hpp"
#include "app/formats/schema_table.hpp"
#include "app/goals/registry.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::app {
namespace {

using Kind = targets::ValueType::Kind;

/// The rows of one table; a key that several ways of a map have in common stands once, but for what they say differently.
struct Rows {
  std::string text;
  std::set<std::string> said;  ///< rows; of choices, whose words are one, their paths
  std::map<std::string, std::vector<std::string>> words = {};  ///< of choices, those of all ways of their map
};

void add_map(Rows& rows, const std::string& prefix, const targets::KeyTable& keys);

std::string meaning_of(const std::string& path, const targets::Key& key) {
  if (key.meaning.empty()) throw InvalidInput("the key `" + path + "` has no documentation");
  return key.meaning;
}

/// A choice says in each way of a map which words lead there: the page shows them all.
void add_words(Rows& rows, const std::string& prefix, const std::vector<targets::ValueType>& ways) {
  for (const targets::ValueType& way : ways) {
    if (way.kind != Kind::map) continue;
    for (const targets::Key& key : way.keys->keys()) {
      if (key.type.kind != Kind::choice) continue;
      std::vector<std::string>& words = rows.words[prefix + key.name];
      for (const std::string& word : key.type.words)
        if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
    }
  }
}

/// The maps that a value may hold, and what stands between its key and theirs.
void add_inner_maps(Rows& rows, const std::string& path, const targets::ValueType& type) {
  if (type.kind == Kind::map && type.keys->title().empty()) add_map(rows, path + ".", *type.keys);
  if (type.kind == Kind::either) add_words(rows, path + ".", type.parts);
  for (const targets::ValueType& part : type.parts)
    add_inner_maps(rows, type.kind == Kind::list ? path + "[]" : path, part);
}

std::string linked_type(const Rows& rows, const std::string& path, targets::ValueType type) {
  if (const auto words = rows.words.find(path); words != rows.words.end() && type.kind == Kind::choice)
    type.words = words->second;
  if (type.kind != Kind::map || type.keys->title().empty()) return type_text(type);
  return fmt::format("section, [see below](#{})", anchor(type.keys->title()));
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
  Rows rows{.text = "| key | what it may be | default | meaning |\n|---|---|---|---|\n", .said = {}};
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

class Page {
 public:
  explicit Page(SchemaText schema) : schema_(schema) {}

  std::string filled(const std::string& page) {
    std::istringstream lines(page);
    std::string text;
    for (std::string line; std::getline(lines, line);)
      text += line.starts_with("{{") && line.ends_with("}}") ? table(line.substr(2, line.size() - 4))
                                                             : line + "\n";
    if (!unused_.empty())
      throw InvalidInput("the page of formats leaves out {{keys " + *unused_.begin() + "}}");
    return text;
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
    throw InvalidInput("the page of formats has the mark {{" + mark + "}}, which stands for nothing");
  }

  SchemaText schema_;
  std::set<std::string> unused_ = names_of_lists();
};

}  // namespace

std::string formats_page(const std::string& page, SchemaText schema) { return Page(schema).filled(page); }

}  // namespace kinetix::app
