#pragma once

#include <concepts>
#include <type_traits>

#include "targets/document/document.hpp"
#include "targets/document/keys.hpp"

namespace kinetix::targets {

/// Returns the first word of each value, which is its name, or all further words.
template <class Value, std::size_t count>
std::vector<std::string_view> names_of(const Word<Value> (&words)[count], bool earlier = false) {
  std::vector<std::string_view> names;
  for (std::size_t k = 0; k < count; ++k)
    if ((first_of(words, k) != k) == earlier) names.push_back(words[k].first);
  return names;
}

/// Returns the value of a word in the file. @throws InvalidInput for any other word
template <class Value, std::size_t count>
Value read_word(const Node& node, const Word<Value> (&words)[count]) {
  std::vector<std::string_view> names = names_of(words);
  const std::vector<std::string_view> earlier = names_of(words, true);
  const std::size_t k = node.one_of(names, earlier);
  names.insert(names.end(), earlier.begin(), earlier.end());
  std::size_t at = 0;
  while (words[at].first != names[k]) ++at;
  return words[at].second;
}

/// Checks that a map holds keys of the table alone, and no key under both its names.
/// @throws InvalidInput for anything but a map, and for a key that the table does not have
void check_keys(const Node& node, const KeyTable& keys);

/// Type with the two ends of a range.
template <class Range>
concept EndsOfRange = requires(Range& range) {
  range.lower = range.upper;
};

/// Map of a file, read by the table that documents it. A key that is not in the table can neither be given nor be
/// read, and the table defines the allowed values. A section that a file omits has no keys.
///
/// read() leaves the value unchanged if the key is not given, so defaults remain. All readers throw InvalidInput at
/// the value's place. They throw std::logic_error if the table lacks the key, or has it with another type.
class Section {
 public:
  /// @param keys lives as long as the section
  /// @throws InvalidInput for anything but a map, and for a key that the table does not have
  Section(const Node& node, const KeyTable& keys);
  Section(const std::optional<Node>& node, const KeyTable& keys);

  /// Whether the file holds the section.
  bool given() const { return node_.has_value(); }
  /// @pre given
  const Node& node() const { return *node_; }
  InvalidInput error(const std::string& fault_text) const { return node_->error(fault_text); }

  /// Whether the table has the key.
  bool knows(std::string_view key) const;
  /// Whether the table gives the key's bounds in cell edges.
  bool is_length(std::string_view key) const;
  /// Returns the value under the key, unread; empty if it is not given.
  std::optional<Node> optional(std::string_view key) const;
  /// @param what what belongs there, for the message when the key is missing. @pre given
  Node required(std::string_view key, const std::string& what) const;
  /// Returns the map under a key, with the table that this table names for it.
  Section section(std::string_view key) const;

  void read(std::string_view key, double& value) const;
  /// @param bounds allowed values, if narrower than the table's
  void read(std::string_view key, double& value, const Bounds& bounds) const;
  /// A length whose bounds the table gives in cell edges. @param edge_mm cell edge
  void read_length(std::string_view key, double& value, double edge_mm) const;
  void read(std::string_view key, int& value) const;
  void read(std::string_view key, bool& value) const;
  /// [lower, upper]; angles in radians.
  void read(std::string_view key, std::array<double, 2>& value) const;
  template <EndsOfRange Range>
  void read(std::string_view key, Range& value) const {
    std::array<double, 2> ends = {value.lower, value.upper};
    read(key, ends);
    value = {ends[0], ends[1]};
  }

  template <class Value, std::size_t count>
  void read(std::string_view key, Value& value, const Word<Value> (&words)[count]) const {
    check_words(key, names_of(words));
    if (const auto node = optional(key)) value = read_word(*node, words);
  }

  /// Reads every key that fills a member of this object, also in nested sections. Keys of other types are left.
  /// @param edge_mm cell edge, for bounds in cell edges
  template <class Object>
  void read_into(Object& object, double edge_mm = 0) const {
    read_into(typeid(Object), &object, edge_mm);
  }

  /// A key that must be given. @param what what belongs there, for the message when it is missing
  template <class Value, class... How>
  void read_needed(std::string_view key, const std::string& what, Value& value, const How&... how) const {
    required(key, what);
    read(key, value, how...);
  }

  /// Reads a value that may stay empty. @param how further arguments of the value's reader
  template <class Value, class... How>
  void read(std::string_view key, std::optional<Value>& value, const How&... how) const {
    if (!optional(key)) return;
    value.emplace();
    read(key, *value, how...);
  }
  void read_length(std::string_view key, std::optional<double>& value, double edge_mm) const {
    if (optional(key)) read_length(key, value.emplace(), edge_mm);
  }

 private:
  void read_into(std::type_index type, void* object, double edge_mm) const;
  const ValueType& type(std::string_view key, ValueType::Kind kind) const;
  double number(const Node& node, const ValueType& type, const Bounds& bounds) const;
  void check_words(std::string_view key, const std::vector<std::string_view>& names) const;

  std::optional<Node> node_;
  const KeyTable* keys_;
};

}  // namespace kinetix::targets

/// How keys of tables are bound to members of objects (Key's constructors with a member).
namespace kinetix::targets {

template <class Value>
inline constexpr bool is_optional = false;
template <class Value>
inline constexpr bool is_optional<std::optional<Value>> = true;

/// A default is what the member holds in a new object; nothing of optional ones that are empty.
template <class Value>
Default default_of(const ValueType& type, const Value& value) {
  const bool in_degrees = type.kind == ValueType::Kind::angle ||
                          (!type.parts.empty() && type.parts[0].kind == ValueType::Kind::angle);
  if constexpr (is_optional<Value>)
    return value ? default_of(type, *value) : Default{};
  else if constexpr (std::same_as<Value, bool>)
    return by_default(value ? "true" : "false");
  else if constexpr (std::is_arithmetic_v<Value>)
    return in_degrees ? by_default_deg(value) : by_default(value);
  else if constexpr (EndsOfRange<Value>)
    return default_of(type, std::array<double, 2>{value.lower, value.upper});
  else
    return in_degrees ? by_default_deg(value[0], value[1]) : by_default(value);
}

template <class Value>
std::string file_text(ValueType::Kind kind, const Value& value) {
  if constexpr (is_optional<Value>)
    return value ? file_text(kind, *value) : std::string();
  else
    return kind == ValueType::Kind::angle ? degrees_text(value) : shortest_text(value);
}

template <class Object>
const Object& new_object() {
  static Object object;  // without braces: GCC 12 frees bases of aggregates twice where a later member throws
  return object;
}

template <class Object, class Value>
Key::Key(std::string name, Value Object::*member, ValueType of, Default fallback, std::string meaning,
         With with)
    : Key(std::move(name), std::move(of), std::move(fallback), std::move(meaning), std::move(with)) {
  binding.object = typeid(Object);
  binding.read = [member](const Section& section, std::string_view key, void* object, double edge_mm) {
    Value& value = static_cast<Object*>(object)->*member;
    if constexpr (std::same_as<Value, double> || std::same_as<Value, std::optional<double>>)
      if (section.is_length(key)) return section.read_length(key, value, edge_mm);
    section.read(key, value);
  };
  if constexpr (is_optional<Value> || std::is_arithmetic_v<Value>)
    binding.text = [member, kind = type.kind](const void* object) {
      return file_text(kind, static_cast<const Object*>(object)->*member);
    };
}

template <class Object, class Value>
Key::Key(std::string name, Value Object::*member, ValueType type, std::string meaning, With with)
    : Key(std::move(name), member, type, default_of(type, new_object<Object>().*member), std::move(meaning),
          std::move(with)) {}

}  // namespace kinetix::targets
