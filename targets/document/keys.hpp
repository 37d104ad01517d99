#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <typeindex>
#include <utility>
#include <vector>

#include "targets/document/number.hpp"

namespace kinetix::targets {

class KeyTable;
class Section;

/// Word of a file, and the value that it represents.
template <class Value>
using Word = std::pair<std::string_view, Value>;

/// Returns the position of the first word that has the same value as word k.
template <class Value, std::size_t count>
std::size_t first_of(const Word<Value> (&words)[count], std::size_t k) {
  std::size_t first = 0;
  while (words[first].second != words[k].second) ++first;
  return first;
}

/// Type of a key's value. The reader checks it; the page of formats and the JSON Schemas are generated from it.
struct ValueType {
  enum class Kind { number, angle, integer, boolean, text, choice, list, map, either };
  /// Entries of a list that has no limit: more than fit in memory.
  static constexpr std::size_t any_length = static_cast<std::size_t>(-1);

  bool is_numeric() const { return kind == Kind::number || kind == Kind::angle || kind == Kind::integer; }

  Kind kind = Kind::text;
  Bounds bounds = {};                   ///< number, angle (in degrees; read as radians), integer
  bool in_cells = false;                ///< number: the bounds are in cell edges, the value is in mm
  std::string form = {};                ///< text, list: how it is written; Markdown
  std::vector<std::string> words = {};  ///< choice: at least one
  /// choice: earlier words that files may still use, each with the word that replaces it
  std::vector<std::pair<std::string, std::string>> old_words = {};
  std::vector<ValueType> parts = {};               ///< list: the type of every entry; either: its ways
  std::size_t shortest = 0, longest = any_length;  ///< list
  std::shared_ptr<const KeyTable> keys = {};       ///< map
};

namespace value {

ValueType number(const Bounds& bounds = {});
/// Returns the type of a length in mm whose bounds follow the cell edge. @param cells bounds in cell edges, with a
/// unit that names them
ValueType length(const Bounds& cells);
ValueType angle(const Bounds& degrees);
ValueType integer(int lower, int upper);
ValueType boolean();
/// @param form what belongs there, e.g. "path of a CSV file"
ValueType text(std::string form);
ValueType choice(std::vector<std::string> words);
/// @param form how it is written, e.g. "`[columns, rows]`"
ValueType list(ValueType entry, std::string form, std::size_t shortest = 1,
               std::size_t longest = ValueType::any_length);
/// [lower, upper]
ValueType range(const Bounds& bounds);
ValueType angle_range(const Bounds& degrees);
ValueType map(KeyTable keys);
ValueType either(std::vector<ValueType> ways);

/// The first word of a value is its name. Further words of the same value are earlier names.
template <class Value, std::size_t count>
ValueType choice(const Word<Value> (&words)[count]) {
  ValueType type = choice(std::vector<std::string>{});
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t first = first_of(words, k);
    if (first == k)
      type.words.emplace_back(words[k].first);
    else
      type.old_words.emplace_back(words[k].first, words[first].first);
  }
  return type;
}

}  // namespace value

/// Value of a key that a file omits.
struct Default {
  enum class Kind {
    needed,     ///< nothing: the key must be given
    literal,    ///< the value `text`, as the file would say it
    described,  ///< what `text` says; empty: see the key's meaning
  };

  Kind kind = Kind::described;
  std::string text = {};  ///< needed: what belongs there, for the message when the key is missing
};

/// Default of keys that have no value if they are omitted.
inline const Default no_default = {};
/// Default of keys that must be given.
inline const Default needed = {Default::Kind::needed, {}};
/// @param what what belongs there, for the message when the key is missing
Default needed_as(std::string what);
/// Returns the value that the program uses, so that the table cannot give another.
Default by_default(double value);
Default by_default(const char* word);
/// @param radians shown in degrees
Default by_default_deg(double radians);
Default by_default(const std::array<double, 2>& range);
Default by_default_deg(double lower_radians, double upper_radians);
/// @param text Markdown: a rule instead of a value
Default otherwise(std::string text);

/// Alternatives of a map (`Alternatives` below) to which a key belongs; none named: all.
struct With {
  With() = default;
  With(const char* name) : names{name} {}             // NOLINT: tables read better
  With(std::string name) : names{std::move(name)} {}  // NOLINT
  With(std::initializer_list<std::string> all) : names(all) {}

  bool all() const { return names.empty(); }

  std::vector<std::string> names;
};

/// The member that a key fills and is written from.
struct Binding {
  std::type_index object = typeid(void);  ///< whose member; void: none, the key is read by name
  std::function<void(const Section& section, std::string_view key, void* object, double edge_mm)> read = {};
  /// Formats a member that is a number as a file has it; an empty function for ranges.
  std::function<std::string(const void* object)> text = {};
};

/// One key of a map.
struct Key {
  Key(std::string name, ValueType type, Default fallback, std::string meaning, With with = {});
  /// A section.
  Key(std::string name, KeyTable keys, std::string meaning, Default fallback = {});
  /// A number, a range or a truth value that fills a member (targets/document/section.hpp).
  template <class Object, class Value>
  Key(std::string name, Value Object::*member, ValueType type, Default fallback, std::string meaning,
      With with = {});
  /// Uses the member's value in a new object as default.
  template <class Object, class Value>
  Key(std::string name, Value Object::*member, ValueType type, std::string meaning, With with = {});

  /// Adds an earlier name. Files may still use it, and kinetix writes it until version 2 of the file format.
  Key formerly(std::string earlier) &&;
  /// Returns the name that files written by kinetix have.
  const std::string& written_name() const { return old_name.empty() ? name : old_name; }

  std::string name;
  ValueType type;
  Default fallback;
  std::string meaning;        ///< meaning in Markdown; units are the type's
  With with = {};             ///< the alternatives to which it belongs
  Binding binding = {};       ///< the member that it fills
  std::string old_name = {};  ///< earlier name; empty: none
};

/// Returns the key `kind` of a target's table.
Key goal_kind_key(std::string kind);

/// Alternative ways to fill a map.
struct Alternatives {
  std::vector<std::string> names = {};
  std::string chosen_by =
      {};  ///< the key whose word names the alternative; empty: each is a key, and one is given
};

/// A key that earlier versions had.
struct RemovedKey {
  std::string name;
  std::string answer;  ///< what replaces it
};

/// The keys that a map of a file may hold, in the order of the documentation and of error messages.
class KeyTable {
 public:
  /// @param title of a separate section of the page, for a map that several kinds of files share; empty: keys are
  /// listed at the map
  explicit KeyTable(std::vector<Key> keys, Alternatives alternatives = {}, std::string title = {},
                    std::vector<RemovedKey> removed = {});

  const std::vector<Key>& keys() const { return keys_; }
  const Alternatives& alternatives() const { return alternatives_; }
  const std::string& title() const { return title_; }
  const std::vector<RemovedKey>& removed() const { return removed_; }
  std::vector<std::string_view> names() const;
  /// Returns the earlier names of the keys that have one.
  std::vector<std::string_view> old_names() const;
  /// Returns the table of the keys that one alternative allows. A key that chooses the alternative allows only its
  /// word.
  KeyTable only(std::string_view alternative) const;
  /// Finds a key by its name or its earlier name. @return null if the table does not have it
  const Key* find(std::string_view name) const;
  /// @throws std::logic_error for a key that the table does not have: whatever is read must be in it
  const Key& at(std::string_view name) const;
  /// Formats numbers that are members of the object, such as "step_s: 0.01, reach_mm: 2". Only keys that must be given
  /// and values that differ from `usual` are listed.
  template <class Object>
  std::string text(const Object& object, const Object& usual = {}) const {
    return text(typeid(Object), &object, &usual);
  }

 private:
  std::string text(std::type_index type, const void* object, const void* usual) const;
  bool is_alternative(std::string_view name) const;

  std::vector<Key> keys_;
  Alternatives alternatives_;
  std::string title_;
  std::vector<RemovedKey> removed_;
};

}  // namespace kinetix::targets
