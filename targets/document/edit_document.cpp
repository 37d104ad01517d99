#include "targets/document/edit_document.hpp"

#include <algorithm>

#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

constexpr int max_position = 100'000'000;  // in a list: beyond any that a file can hold, within int

InvalidInput malformed(std::string_view text, const std::string& why) {
  return InvalidInput(in_ticks(text) + " is not a path: " + why +
                      ". Write keys with points and positions in brackets, e.g. `design.hinges[3].tilt_deg` "
                      "or `design.hinges[*].tilt_deg`");
}

PathStep parse_position(std::string_view text, std::string_view inside) {
  if (inside == "*") return {"", PathStep::every};
  const bool digits = !inside.empty() && inside.find_first_not_of("0123456789") == std::string_view::npos;
  if (!digits) throw malformed(text, in_ticks(inside) + " is in brackets");
  return {"", parse_integer(inside, 0, max_position)};
}

}  // namespace

DocumentPath parse_path(std::string_view text) {
  DocumentPath path;
  std::size_t at = 0;
  while (at < text.size()) {
    if (text[at] == '[') {
      const std::size_t end = text.find(']', at);
      if (end == std::string_view::npos) throw malformed(text, "a `]` is missing");
      if (path.empty()) throw malformed(text, "it starts with a position");
      path.push_back(parse_position(text, text.substr(at + 1, end - at - 1)));
      at = end + 1;
      continue;
    }
    if (!path.empty() && text[at++] != '.') throw malformed(text, "a point is missing");
    const std::size_t end = std::min(text.find_first_of(".[", at), text.size());
    if (end == at) throw malformed(text, "a key is empty");
    path.push_back({std::string(text.substr(at, end - at)), 0});
    at = end;
  }
  if (path.empty()) throw malformed(text, "it is empty");
  return path;
}

std::string to_string(const DocumentPath& path) {
  std::string text;
  for (const PathStep& step : path) {
    if (step.key.empty())
      text += "[" + (step.position == PathStep::every ? "*" : std::to_string(step.position)) + "]";
    else
      text += (text.empty() ? "" : ".") + step.key;
  }
  return text;
}

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

namespace {

/// Copies an item and all below it to a place of a tree. The copies have no line, since no file holds them.
void graft(const Tree& from, int item, Tree& to, int place) {
  const Tree::Item& source = from.items[item];
  Tree::Item& target = to.items[place];
  target.kind = source.kind;
  target.is_quoted = source.is_quoted;
  target.value = source.value;
  target.line = target.column = target.key_line = target.key_column = 0;
  target.children.clear();
  for (const int child : source.children) {
    const int added = static_cast<int>(to.items.size());
    to.items[place].children.push_back(added);
    Tree::Item& entry = to.items.emplace_back();
    entry.parent = place;
    entry.position = from.items[child].position;
    entry.key = from.items[child].key;
    graft(from, child, to, added);
  }
}

}  // namespace

void DocumentEditor::put(const DocumentPath& path, const std::string& yaml) {
  const Node value = parse_document("value: " + yaml, tree_->file).required("value", "");
  int item = 0;
  for (const PathStep& step : path) {
    const Node::Kind kind = tree_->items[item].kind;
    if (kind != Node::Kind::map && kind != Node::Kind::empty)
      throw Node(tree_, item).error("is not a map of keys");
    item = child(item, step.key, true);
  }
  graft(value.tree(), value.item(), *tree_, item);
}

Node DocumentEditor::root() const { return {tree_, 0}; }

Node read_changed_document(const std::string& file, std::size_t most_bytes, const DocumentChanges& changes) {
  const Node root = read_document(file, most_bytes);
  if (changes.empty()) return root;
  DocumentEditor changed(root);
  for (const auto& [path, value] : changes) changed.put(parse_path(path), value);
  return changed.root();
}

}  // namespace kinetix::targets
