#pragma once

#include "targets/document/document.hpp"

namespace kinetix::targets {

/// One step of a path: a key of a map, or a position in a list (from 0), or every entry of one.
struct PathStep {
  static constexpr int every = -1;  ///< as position: each entry of the list; no entry has it

  std::string key;  ///< empty for a position
  int position = 0;

  bool operator==(const PathStep&) const = default;
};

/// `design.hinges[3].t`, `design.hinges[*].beta_deg`: dotted keys, positions in brackets.
using DocumentPath = std::vector<PathStep>;

/// @throws InvalidInput without a place, saying what is wrong
DocumentPath parse_path(std::string_view text);
std::string to_string(const DocumentPath& path);

/// A copy of a document in which values are replaced, as if the file held them.
class DocumentEditor {
 public:
  explicit DocumentEditor(const Node& root);
  DocumentEditor(const DocumentEditor& other);
  DocumentEditor& operator=(const DocumentEditor&) = delete;

  /// Returns the paths of the numbers in the file, in its order.
  std::vector<std::string> numbers() const;
  /// Finds the items of the numbers that a path matches, in file order; empty if there are none.
  std::vector<int> find(const DocumentPath& path) const;
  /// Finds the items of the numbers that a path matches, in file order. Keys at the end of the path that the file
  /// omits are added to its maps. Empty if the path meets anything but maps and lists.
  std::vector<int> find_or_add(const DocumentPath& path);

  std::string path(int item) const;
  /// Returns the number as the file has it, in the key's unit; empty for a key that was added and not set.
  std::optional<double> number(int item) const;
  void set(int item, double value);
  /// Replaces or adds a value. Maps that the file omits are added.
  /// @param path of keys alone   @param yaml such as `pin` or `[220, 220]`
  /// @throws InvalidInput if that is not YAML, or if the path meets anything but maps
  void put(const DocumentPath& path, const std::string& yaml);

  /// Returns the document in its present state. It must not be used after the next set().
  Node root() const;

 private:
  void collect(const DocumentPath& path, std::size_t step, int item, bool add, std::vector<int>& found);
  int child(int item, const std::string& key, bool add);

  std::shared_ptr<Tree> tree_;
};

/// Paths of keys and the YAML text of their new values, for DocumentEditor::put.
using DocumentChanges = std::vector<std::pair<std::string, std::string>>;

/// Reads a file once and makes the changes in the copy.
/// @throws InvalidInput for a file that read_document() refuses, and for a change that put() refuses
Node read_changed_document(const std::string& file, std::size_t most_bytes, const DocumentChanges& changes);

}  // namespace kinetix::targets
