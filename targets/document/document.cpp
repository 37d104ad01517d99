#include "targets/document/document.hpp"

#include <algorithm>
#include <filesystem>

#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

std::string name(Node::Kind kind) {
  switch (kind) {
    case Node::Kind::empty:
      return "nothing";
    case Node::Kind::scalar:
      return "a single value";
    case Node::Kind::list:
      return "a list";
    case Node::Kind::map:
      break;
  }
  return "a map of keys";
}

bool has_control_character(const std::string& text) {
  return std::any_of(text.begin(), text.end(),
                     [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
}

}  // namespace

Node::Kind Node::kind() const { return tree_->items[item_].kind; }

Place Node::place() const {
  const Tree::Item& item = tree_->items[item_];
  return {tree_->file, item.line, item.column, tree_->path(item_)};
}

InvalidInput Node::error(const std::string& fault_text) const { return InvalidInput(fault_text, place()); }

InvalidInput Node::key_error(const std::string& fault_text) const {
  const Tree::Item& item = tree_->items[item_];
  return InvalidInput(fault_text, {tree_->file, item.key_line, item.key_column, tree_->path(item_)});
}

std::string Node::folder() const { return std::filesystem::path(tree_->file).parent_path().string(); }

void Node::reject_kind(const std::string& wanted) const {
  if (kind() == Kind::empty) throw error("is empty. Give " + wanted);
  throw error("is " + name(kind()) + ". Give " + wanted);
}

void Node::reject_unknown_keys(const std::vector<std::string_view>& allowed,
                               const std::vector<std::string_view>& earlier) const {
  const Names names(allowed);
  if (kind() != Kind::map) reject_kind("a map of keys (" + joined(names) + ")");
  for (const int child : tree_->items[item_].children) {
    const std::string& key = tree_->items[child].key;
    if (std::find(names.begin(), names.end(), key) != names.end() ||
        std::find(earlier.begin(), earlier.end(), key) != earlier.end())
      continue;
    if (key.find_first_not_of("0123456789") == std::string::npos)
      throw Node(tree_, child)
          .key_error("a number is in the place of a key. Write decimals with a point, not a comma");
    std::vector<std::string_view> known = allowed;
    known.insert(known.end(), earlier.begin(), earlier.end());
    throw Node(tree_, child)
        .key_error("unknown key" + did_you_mean(key, known) + "; allowed: " + joined(names));
  }
}

std::optional<Node> Node::optional(std::string_view key) const {
  if (kind() != Kind::map) reject_kind("a map of keys with `" + std::string(key) + "`");
  for (const int child : tree_->items[item_].children)
    if (tree_->items[child].key == key) return Node(tree_, child);
  return std::nullopt;
}

Node Node::required(std::string_view key, const std::string& what) const {
  if (const auto value = optional(key)) return *value;
  throw error("the key `" + std::string(key) + "` is missing. Give " + what);
}

std::vector<Node> Node::list(const std::string& what) const {
  if (kind() != Kind::list) reject_kind(what);
  std::vector<Node> nodes;
  for (const int child : tree_->items[item_].children) nodes.emplace_back(tree_, child);
  return nodes;
}

std::vector<Node> Node::list_of(std::size_t length, const std::string& what) const {
  auto nodes = list(what);
  if (nodes.size() != length)
    throw error("has " + std::to_string(nodes.size()) + (nodes.size() == 1 ? " entry" : " entries") +
                ". Give " + what);
  return nodes;
}

const std::string& Node::plain_scalar(const std::string& wanted) const {
  if (kind() != Kind::scalar) reject_kind(wanted);
  const Tree::Item& item = tree_->items[item_];
  if (item.is_quoted) throw error("is in quotes, which makes it text. Give " + wanted + ", without quotes");
  return item.value;
}

double Node::number(const Bounds& bounds) const {
  const std::string& value = plain_scalar(bounds.describe());
  return located([&] { return parse_number(value, bounds); });
}

double Node::angle(const Bounds& degrees) const {
  const std::string& value = plain_scalar(degrees.describe());
  return located([&] { return parse_degrees(value, degrees); });
}

int Node::integer(int lower, int upper) const {
  const std::string& value = plain_scalar("a whole number");
  return located([&] { return parse_integer(value, lower, upper); });
}

bool Node::boolean() const {
  const std::string& value = plain_scalar("true or false");
  if (value != "true" && value != "false")
    throw error(in_ticks(value) + " is not allowed. Give true or false");
  return value == "true";
}

std::string Node::text(const std::string& what) const {
  if (kind() != Kind::scalar) reject_kind(what);
  const std::string& value = tree_->items[item_].value;
  if (value.empty()) throw error("is empty. Give " + what);
  if (has_control_character(value)) throw error("has a control character. Give " + what);
  return value;
}

std::size_t Node::one_of(const std::vector<std::string_view>& allowed,
                         const std::vector<std::string_view>& earlier) const {
  const std::string value = text("one of: " + joined(allowed));
  const auto it = std::find(allowed.begin(), allowed.end(), value);
  if (it != allowed.end()) return static_cast<std::size_t>(it - allowed.begin());
  const auto old = std::find(earlier.begin(), earlier.end(), value);
  if (old == earlier.end())
    throw error(in_ticks(value) + " is not known" + did_you_mean(value, allowed) +
                "; allowed: " + joined(allowed));
  return allowed.size() + static_cast<std::size_t>(old - earlier.begin());
}

std::array<double, 2> Node::range(const Bounds& bounds) const {
  const auto ends = list_of(2, "[lower, upper], each " + bounds.describe());
  const std::array<double, 2> out = {ends[0].number(bounds), ends[1].number(bounds)};
  if (out[0] == out[1]) throw error("lower and upper are equal. Give [lower, upper] with lower below upper");
  if (out[0] > out[1])
    throw error("the range is reversed: " + shortest_text(out[0]) + " is above " + shortest_text(out[1]) +
                ". Give [lower, upper] with lower below upper");
  return out;
}

std::array<double, 2> Node::angle_range(const Bounds& degrees) const {
  range(degrees);
  const auto ends = list("[lower, upper]");
  return {ends[0].angle(degrees), ends[1].angle(degrees)};
}

std::string Tree::path(int item) const {
  std::vector<int> chain;
  for (; items[item].parent >= 0; item = items[item].parent) chain.push_back(item);
  std::reverse(chain.begin(), chain.end());
  std::string text;
  for (const int link : chain) {
    const Item& at = items[link];
    if (items[at.parent].kind == Node::Kind::list)
      text += "[" + std::to_string(at.position) + "]";
    else
      text += (text.empty() ? "" : ".") + at.key;
  }
  return text;
}

}  // namespace kinetix::targets
