#include "targets/document/edit_document.hpp"

#include "targets/document/number.hpp"
#include "targets/document/tree.hpp"

namespace kinetix::targets {
namespace {

bool is_number(const Tree::Item& item) {
  if (item.kind != Node::Kind::scalar || item.is_quoted) return false;
  try {
    parse_number(item.value);
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

}  // namespace

DocumentEditor::DocumentEditor(const Node& root) : tree_(std::make_shared<Tree>(root.tree())) {}

DocumentEditor::DocumentEditor(const DocumentEditor& other) : tree_(std::make_shared<Tree>(*other.tree_)) {}

std::vector<std::string> DocumentEditor::numbers() const {
  std::vector<std::string> paths;
  for (std::size_t k = 0; k < tree_->items.size(); ++k)
    if (is_number(tree_->items[k])) paths.push_back(tree_->path(static_cast<int>(k)));
  return paths;
}

std::vector<int> DocumentEditor::find(const DocumentPath& path) const {
  std::vector<int> found;
  DocumentEditor(*this).collect(path, 0, 0, false, found);
  return found;
}

std::vector<int> DocumentEditor::find_or_add(const DocumentPath& path) {
  std::vector<int> found;
  collect(path, 0, 0, true, found);
  return found;
}

int DocumentEditor::child(int item, const std::string& key, bool add) {
  for (const int c : tree_->items[item].children)
    if (tree_->items[c].key == key) return c;
  if (!add) return -1;
  const int added = static_cast<int>(tree_->items.size());
  Tree::Item entry;
  entry.parent = item;
  entry.position = static_cast<int>(tree_->items[item].children.size());
  entry.key = key;
  tree_->items.push_back(entry);
  tree_->items[item].kind = Node::Kind::map;
  tree_->items[item].children.push_back(added);
  return added;
}

void DocumentEditor::collect(const DocumentPath& path, std::size_t step, int item, bool add,
                             std::vector<int>& found) {
  const Node::Kind kind = tree_->items[item].kind;
  if (step == path.size()) {
    if (is_number(tree_->items[item]) || (add && kind == Node::Kind::empty)) found.push_back(item);
    return;
  }
  const PathStep& next = path[step];
  if (!next.key.empty()) {
    if (kind != Node::Kind::map && !(add && kind == Node::Kind::empty)) return;
    const int c = child(item, next.key, add);
    if (c >= 0) collect(path, step + 1, c, add, found);
    return;
  }
  if (kind != Node::Kind::list) return;
  const std::vector<int> entries = tree_->items[item].children;
  for (std::size_t k = 0; k < entries.size(); ++k)
    if (next.position == PathStep::every || next.position == static_cast<int>(k))
      collect(path, step + 1, entries[k], add, found);
}

std::string DocumentEditor::path(int item) const { return tree_->path(item); }

std::optional<double> DocumentEditor::number(int item) const {
  if (tree_->items[item].kind == Node::Kind::empty) return std::nullopt;
  return parse_number(tree_->items[item].value);
}

void DocumentEditor::set(int item, double value) {
  Tree::Item& at = tree_->items[item];
  at.kind = Node::Kind::scalar;
  at.is_quoted = false;
  at.value = shortest_text(value);
}

Node DocumentEditor::root() const { return {tree_, 0}; }

}  // namespace kinetix::targets
