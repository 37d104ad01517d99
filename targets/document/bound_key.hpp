#pragma once

#include <concepts>
#include <type_traits>

#include "targets/document/section.hpp"

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
