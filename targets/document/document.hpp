#pragma once

#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "model/base/invalid_input.hpp"
#include "targets/document/number.hpp"

namespace kinetix::targets {

struct Tree;

/// One value of a YAML document: a map in file order, a list, a scalar, or nothing. A cheap handle that keeps
/// its document alive. Every getter throws InvalidInput with the value's place, saying what is allowed.
class Node {
 public:
  enum class Kind { empty, scalar, list, map };

  Node(std::shared_ptr<const Tree> tree, int item) : tree_(std::move(tree)), item_(item) {}

  Kind kind() const;
  /// The dotted path includes list positions from 0: "design.hinges[2].wall[0]".
  Place place() const;
  InvalidInput error(const std::string& fault_text) const;
  /// error() at the place of the key, not of its value. @pre a value in a map
  InvalidInput key_error(const std::string& fault_text) const;
  /// Folder of the document; relative paths inside it start there.
  std::string folder() const;
  /// The document that the value is part of.
  const Tree& tree() const { return *tree_; }
  /// Index of the value in tree().items.
  int item() const { return item_; }

  /// Map getters. An empty value (`key:` alone) is present, and every other getter refuses it.
  /// @param earlier keys that are allowed as well, and that messages do not list
  void reject_unknown_keys(const std::vector<std::string_view>& allowed,
                           const std::vector<std::string_view>& earlier = {}) const;
  std::optional<Node> optional(std::string_view key) const;
  /// @param what what belongs there, for the message when the key is missing
  Node required(std::string_view key, const std::string& what) const;

  /// List getters. `what` describes the list, e.g. "[lower, upper] in degrees".
  std::vector<Node> list(const std::string& what) const;
  std::vector<Node> list_of(std::size_t length, const std::string& what) const;

  /// Scalar getters. Numbers and booleans must not be in quotes; text may be.
  double number(const Bounds& bounds = {}) const;
  /// Reads a value in degrees and returns radians.
  double angle(const Bounds& degrees) const;
  int integer(int lower, int upper) const;
  bool boolean() const;
  std::string text(const std::string& what) const;
  /// Returns the position of the word among the allowed ones, followed by the earlier ones.
  /// @param earlier words that are allowed as well, and that messages do not list
  std::size_t one_of(const std::vector<std::string_view>& allowed,
                     const std::vector<std::string_view>& earlier = {}) const;

  /// Reads [lower, upper] with lower < upper, both in bounds.
  std::array<double, 2> range(const Bounds& bounds) const;
  /// Reads [lower, upper] in degrees with lower < upper, both in bounds, and returns radians.
  std::array<double, 2> angle_range(const Bounds& degrees) const;

  /// Runs f; bad input that it reports without a place gets this one.
  template <class F>
  auto located(F&& f) const {
    try {
      return f();
    } catch (const InvalidInput& e) {
      if (e.place().line > 0) throw;
      throw error(e.reason());
    }
  }

 private:
  const std::string& plain_scalar(const std::string& wanted) const;
  [[noreturn]] void reject_kind(const std::string& wanted) const;

  std::shared_ptr<const Tree> tree_;
  int item_ = 0;
};

/// Bytes, 1 MiB: far more than a target written by hand. Designs may be larger (app/files/design_file.hpp).
inline constexpr std::size_t max_document_bytes = 1 << 20;
/// Deepest nesting of maps and lists. The formats need about six; the limit protects the stack from hostile files.
inline constexpr int max_document_depth = 64;
/// Longest key, bytes: none of the formats is half as long, and messages that name one stay readable.
inline constexpr std::size_t max_key_bytes = 100;

/// Reads a YAML file strictly. Anything that configuration does not need is an error, found while parsing and before
/// anything is built. Refused are anchors, aliases, tags, duplicate keys, a second document, and text that is not
/// UTF-8. Keys that are not plain words of at most 100 bytes, nesting over 64, and files over max_bytes (1 MiB) are
/// also refused. CRLF line ends and a byte order mark are allowed.
/// @throws InvalidInput naming file:line:column and the key path
Node read_document(const std::string& file, std::size_t max_bytes = max_document_bytes);

/// Parses a YAML document from memory, as strictly as read_document. `file` serves for messages and relative paths.
Node parse_document(const std::string& text, const std::string& file);

/// The values of a document in file order, children by index: what a Node points into.
struct Tree {
  struct Item {
    Node::Kind kind = Node::Kind::empty;
    bool is_quoted = false;
    int parent = -1;
    int position = 0;   ///< among the parent's children
    std::string key;    ///< in a map
    std::string value;  ///< of a scalar
    int line = 0, column = 0;
    int key_line = 0, key_column = 0;
    std::vector<int> children;
  };

  std::string file;
  std::vector<Item> items;

  std::string path(int item) const;
};

}  // namespace kinetix::targets
