#include "targets/document/section.hpp"

#include <algorithm>

namespace kinetix::targets {
namespace {

using Kind = ValueType::Kind;

[[noreturn]] void reject_type(std::string_view key) {
  throw std::logic_error("the key `" + std::string(key) + "` is of another type in its table");
}

Bounds scaled(Bounds cells, double edge_mm) {
  cells.lower *= edge_mm;
  cells.upper *= edge_mm;
  return cells;
}

}  // namespace

void check_keys(const Node& node, const KeyTable& keys) {
  if (node.kind() == Node::Kind::map) {
    for (const RemovedKey& removed : keys.removed())
      if (const auto given = node.optional(removed.name)) throw given->key_error(removed.answer);
    for (const Key& key : keys.keys())
      if (!key.old_name.empty() && node.optional(key.name))
        if (const auto old = node.optional(key.old_name))
          throw old->key_error("`" + key.old_name + "` is the earlier name of `" + key.name +
                               "`, which is given as well. Remove one of the two keys");
  }
  node.reject_unknown_keys(keys.names(), keys.old_names());
}

Section::Section(const Node& node, const KeyTable& keys) : Section(std::optional(node), keys) {}

Section::Section(const std::optional<Node>& node, const KeyTable& keys) : node_(node), keys_(&keys) {
  if (node) check_keys(*node, keys);
}

bool Section::knows(std::string_view key) const { return keys_->find(key) != nullptr; }

std::optional<Node> Section::optional(std::string_view key) const {
  const Key& known = keys_->at(key);
  if (!node_) return std::nullopt;
  const std::optional<Node> value = node_->optional(known.name);
  return value || known.old_name.empty() ? value : node_->optional(known.old_name);
}

Node Section::required(std::string_view key, const std::string& what) const {
  if (keys_->at(key).fallback.kind != Default::Kind::needed)
    throw std::logic_error("the key `" + std::string(key) + "` is needed, but its table gives a default");
  const std::optional<Node> value = optional(key);
  return value ? *value : node_->required(keys_->at(key).name, what);
}

const ValueType& Section::type(std::string_view key, Kind kind) const {
  const ValueType& type = keys_->at(key).type;
  if (type.kind != kind) reject_type(key);
  return type;
}

void Section::read_into(std::type_index type, void* object, double edge_mm) const {
  for (const Key& key : keys_->keys())
    if (key.binding.object == type) {
      if (key.fallback.kind == Default::Kind::needed) required(key.name, key.fallback.text);
      key.binding.read(*this, key.name, object, edge_mm);
    } else if (key.type.kind == Kind::map && optional(key.name)) {
      section(key.name).read_into(type, object, edge_mm);
    }
}

bool Section::is_length(std::string_view key) const { return keys_->at(key).type.in_cells; }

Section Section::section(std::string_view key) const { return {optional(key), *type(key, Kind::map).keys}; }

double Section::number(const Node& node, const ValueType& type, const Bounds& bounds) const {
  return type.kind == Kind::angle ? node.angle(bounds) : node.number(bounds);
}

void Section::read(std::string_view key, double& value) const {
  read(key, value, keys_->at(key).type.bounds);
}

void Section::read(std::string_view key, double& value, const Bounds& bounds) const {
  const ValueType& type = keys_->at(key).type;
  if ((type.kind != Kind::number && type.kind != Kind::angle) || type.in_cells) reject_type(key);
  if (const auto node = optional(key)) value = number(*node, type, bounds);
}

void Section::read_length(std::string_view key, double& value, double edge_mm) const {
  const ValueType& length = type(key, Kind::number);
  if (!length.in_cells) reject_type(key);
  if (const auto node = optional(key)) value = node->number(scaled(length.bounds, edge_mm));
}

void Section::read(std::string_view key, int& value) const {
  const Bounds& bounds = type(key, Kind::integer).bounds;
  if (const auto node = optional(key))
    value = node->integer(static_cast<int>(bounds.lower), static_cast<int>(bounds.upper));
}

void Section::read(std::string_view key, bool& value) const {
  type(key, Kind::boolean);
  if (const auto node = optional(key)) value = node->boolean();
}

void Section::read(std::string_view key, std::array<double, 2>& value) const {
  const ValueType& entry = type(key, Kind::list).parts[0];
  const auto node = optional(key);
  if (node) value = entry.kind == Kind::angle ? node->angle_range(entry.bounds) : node->range(entry.bounds);
}

void Section::check_words(std::string_view key, const std::vector<std::string_view>& names) const {
  const std::vector<std::string>& words = type(key, Kind::choice).words;
  if (!std::equal(words.begin(), words.end(), names.begin(), names.end())) reject_type(key);
}

}  // namespace kinetix::targets
