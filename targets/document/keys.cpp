#include "targets/document/keys.hpp"

#include <charconv>
#include <stdexcept>

#include "model/base/geometry.hpp"

namespace kinetix::targets {
namespace {

std::string pair_text(const std::string& lower, const std::string& upper) {
  return "[" + lower + ", " + upper + "]";
}

/// Formats degrees as a person would write them. A default is stored in radians, and differs from a round number in
/// the last bit.
std::string shown_degrees(double radians) {
  constexpr int digits = 12;  // fewer than the 15 that a double keeps
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, radians * 180 / pi + 0.0,
                                 std::chars_format::general, digits);
  return {buffer, end.ptr};
}

}  // namespace

namespace value {

using Kind = ValueType::Kind;

ValueType number(const Bounds& bounds) { return {.kind = Kind::number, .bounds = bounds}; }

ValueType length(const Bounds& cells) { return {.kind = Kind::number, .bounds = cells, .in_cells = true}; }

ValueType angle(const Bounds& degrees) { return {.kind = Kind::angle, .bounds = degrees}; }

ValueType integer(int lower, int upper) { return {.kind = Kind::integer, .bounds = from_to(lower, upper)}; }

ValueType boolean() { return {.kind = Kind::boolean}; }

ValueType text(std::string form) { return {.kind = Kind::text, .form = std::move(form)}; }

ValueType choice(std::vector<std::string> words) { return {.kind = Kind::choice, .words = std::move(words)}; }

ValueType list(ValueType entry, std::string form, std::size_t shortest, std::size_t longest) {
  return {.kind = Kind::list,
          .form = std::move(form),
          .parts = {std::move(entry)},
          .shortest = shortest,
          .longest = longest};
}

ValueType range(const Bounds& bounds) { return list(number(bounds), "`[lower, upper]`", 2, 2); }

ValueType angle_range(const Bounds& degrees) { return list(angle(degrees), "`[lower, upper]`", 2, 2); }

ValueType map(KeyTable keys) {
  return {.kind = Kind::map, .keys = std::make_shared<const KeyTable>(std::move(keys))};
}

ValueType either(std::vector<ValueType> ways) { return {.kind = Kind::either, .parts = std::move(ways)}; }

}  // namespace value

Default needed_as(std::string what) { return {Default::Kind::needed, std::move(what)}; }

Default by_default(double value) { return {Default::Kind::literal, shortest_text(value)}; }

Default by_default(const char* word) { return {Default::Kind::literal, word}; }

Default by_default_deg(double radians) { return {Default::Kind::literal, shown_degrees(radians)}; }

Default by_default(const std::array<double, 2>& range) {
  return {Default::Kind::literal, pair_text(shortest_text(range[0]), shortest_text(range[1]))};
}

Default by_default_deg(double lower_radians, double upper_radians) {
  return {Default::Kind::literal, pair_text(shown_degrees(lower_radians), shown_degrees(upper_radians))};
}

Default otherwise(std::string text) { return {Default::Kind::described, std::move(text)}; }

Key::Key(std::string name, ValueType type, Default fallback, std::string meaning, With with)
    : name(std::move(name)),
      type(std::move(type)),
      fallback(std::move(fallback)),
      meaning(std::move(meaning)),
      with(std::move(with)) {}

Key::Key(std::string name, KeyTable keys, std::string meaning, Default fallback)
    : Key(std::move(name), value::map(std::move(keys)), std::move(fallback), std::move(meaning)) {}

Key Key::formerly(std::string earlier) && {
  old_name = std::move(earlier);
  return std::move(*this);
}

Key goal_kind_key(std::string kind) {
  return {"kind", value::choice(std::vector<std::string>{std::move(kind)}), needed, "the kind of goal"};
}

KeyTable::KeyTable(std::vector<Key> keys, Alternatives alternatives, std::string title,
                   std::vector<RemovedKey> removed)
    : keys_(std::move(keys)),
      alternatives_(std::move(alternatives)),
      title_(std::move(title)),
      removed_(std::move(removed)) {}

std::vector<std::string_view> KeyTable::names() const {
  std::vector<std::string_view> names;
  for (const Key& key : keys_) names.push_back(key.name);
  return names;
}

std::vector<std::string_view> KeyTable::old_names() const {
  std::vector<std::string_view> names;
  for (const Key& key : keys_)
    if (!key.old_name.empty()) names.push_back(key.old_name);
  return names;
}

bool KeyTable::is_alternative(std::string_view name) const {
  const auto& names = alternatives_.names;
  return alternatives_.chosen_by.empty() && std::find(names.begin(), names.end(), name) != names.end();
}

namespace {

bool is_one_of(const std::vector<std::string>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

KeyTable KeyTable::only(std::string_view alternative) const {
  std::vector<Key> kept;
  for (const Key& key : keys_)
    if (key.name == alternative ||
        (!is_alternative(key.name) && (key.with.all() || is_one_of(key.with.names, alternative))))
      kept.push_back(key);
  for (Key& key : kept)
    if (key.name == alternatives_.chosen_by) {
      key.type.words = {std::string(alternative)};
      std::erase_if(key.type.old_words, [&](const auto& old) { return old.second != alternative; });
    }
  return KeyTable(std::move(kept));
}

const Key* KeyTable::find(std::string_view name) const {
  for (const Key& key : keys_)
    if (key.name == name || (!key.old_name.empty() && key.old_name == name)) return &key;
  return nullptr;
}

const Key& KeyTable::at(std::string_view name) const {
  if (const Key* key = find(name)) return *key;
  throw std::logic_error("the key `" + std::string(name) + "` is read, but its table does not have it");
}

std::string KeyTable::text(std::type_index type, const void* object, const void* usual) const {
  std::string text;
  for (const Key& key : keys_) {
    if (key.binding.object != type) continue;
    const std::string value = key.binding.text(object);
    const bool is_given = key.fallback.kind == Default::Kind::needed || value != key.binding.text(usual);
    if (is_given) text += (text.empty() ? "" : ", ") + key.written_name() + ": " + value;
  }
  return text;
}

}  // namespace kinetix::targets
