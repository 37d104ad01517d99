#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "targets/document/document.hpp"

namespace kinetix::testing {

/// Converts a scalar as an editor does: to a number or a boolean unless it is quoted.
inline nlohmann::json scalar_json(const targets::Tree::Item& item) {
  if (item.is_quoted) return item.value;
  if (item.value == "true" || item.value == "false") return item.value == "true";
  try {
    targets::parse_number(item.value);
  } catch (const InvalidInput&) {
    return item.value;
  }
  const nlohmann::json number = nlohmann::json::parse(item.value, nullptr, false);
  return number.is_number() ? number : nlohmann::json(targets::parse_number(item.value));
}

/// Converts a YAML document to JSON.
inline nlohmann::json as_json(const targets::Node& node) {
  const targets::Tree::Item& item = node.tree().items[node.item()];
  switch (node.kind()) {
    case targets::Node::Kind::empty:
      return nullptr;
    case targets::Node::Kind::scalar:
      return scalar_json(item);
    case targets::Node::Kind::list: {
      nlohmann::json list = nlohmann::json::array();
      for (const targets::Node& entry : node.list("a list")) list.push_back(as_json(entry));
      return list;
    }
    case targets::Node::Kind::map:
      break;
  }
  nlohmann::json map = nlohmann::json::object();
  for (const int child : item.children) {
    const std::string& key = node.tree().items[child].key;
    map[key] = as_json(*node.optional(key));
  }
  return map;
}

}  // namespace kinetix::testing
