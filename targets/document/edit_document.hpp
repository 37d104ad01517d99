#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "targets/document/document.hpp"
#include "targets/document/document_path.hpp"

namespace kinetix::targets {

/// A copy of a document in which numbers are replaced, as if the file held them.
class DocumentEditor {
 public:
  explicit DocumentEditor(const Node& root);
  DocumentEditor(const DocumentEditor& other);
  DocumentEditor& operator=(const DocumentEditor&) = delete;

  /// Paths of the numbers that the file holds, in its order.
  std::vector<std::string> numbers() const;
  /// Items of the numbers that a path matches, in file order; empty where nothing is there.
  std::vector<int> find(const DocumentPath& path) const;
  /// Items likewise; keys at the end of the path that the file leaves out are added to its maps.
  /// Empty where the path meets something else than maps and lists.
  std::vector<int> find_or_add(const DocumentPath& path);

  std::string path(int item) const;
  /// As the file has it, in the key's own unit. Nothing for a key that was added and not set.
  std::optional<double> number(int item) const;
  void set(int item, double value);

  /// The document as it is now. Not to be used after the next set().
  Node root() const;

 private:
  void collect(const DocumentPath& path, std::size_t step, int item, bool add, std::vector<int>& found);
  int child(int item, const std::string& key, bool add);

  std::shared_ptr<Tree> tree_;
};

}  // namespace kinetix::targets
