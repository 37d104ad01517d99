#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>
#include <algorithm>
#include <sstream>
#include <unordered_map>

#include "targets/document/document.hpp"
#include "targets/document/text_file.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

// Why anchors and aliases are refused, wherever the parser meets them.
constexpr const char* no_anchors = "anchors (&name) and aliases (*name) are not allowed. Write the value out";

struct Position {
  int line = 0, column = 0;
};

/// Columns in characters for positions that mostly ascend, so that long lines are walked once.
class ColumnCounter {
 public:
  explicit ColumnCounter(const std::string& text) : text_(text) {}

  int column(std::size_t position) const {
    const auto from = text_.begin() + static_cast<std::ptrdiff_t>(position_);
    if (position < position_ ||
        std::count(from, from + static_cast<std::ptrdiff_t>(position - position_), '\n'))
      column_ = column_of(text_, position);
    else
      column_ += characters(text_, position_, position);
    position_ = position;
    return column_;
  }

 private:
  const std::string& text_;
  mutable std::size_t position_ = 0;
  mutable int column_ = 1;
};

/// Builds the tree from the parser's events and refuses what is not allowed before it is built.
class Builder final : public YAML::EventHandler {
 public:
  Builder(const std::string& text, Tree& tree) : text_(text), tree_(tree) {}

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ == 1) return;
    refuse(mark, text_.compare(static_cast<std::size_t>(mark.pos), 3, "---") == 0
                     ? "the file has a second document (`---`). Give one only"
                     : "there is text after the end of the document. Check indentation and brackets");
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    check(mark, anchor, "?");
    if (awaits_key()) refuse(mark, "a key is missing before the `:`");
    add(mark, Node::Kind::empty);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { refuse(mark, no_anchors); }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    check(mark, anchor, tag);
    if (awaits_key()) return add_key(mark, value);
    Tree::Item& item = tree_.items[add(mark, Node::Kind::scalar)];
    item.value = value;
    item.is_quoted = tag == "!";
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, Node::Kind::list);
  }
  void OnSequenceEnd() override { open_.pop_back(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, Node::Kind::map);
  }
  void OnMapEnd() override { open_.pop_back(); }

  Position position(const YAML::Mark& mark) const {
    if (mark.is_null()) return {};
    return {mark.line + 1, columns_.column(std::min(static_cast<std::size_t>(mark.pos), text_.size()))};
  }

  Place place(const YAML::Mark& mark) const {
    const auto [line, column] = position(mark);
    return {tree_.file, line, column, open_path()};
  }

 private:
  struct Open {
    int item;
    bool awaits_key;
    std::string key = {};
    Position key_position = {};
    std::unordered_map<std::string, int> line_of_key = {};
  };

  bool awaits_key() const { return !open_.empty() && open_.back().awaits_key; }

  bool is_in_map() const { return !open_.empty() && tree_.items[open_.back().item].kind == Node::Kind::map; }

  std::string open_path() const {
    if (open_.empty()) return {};
    std::string path = tree_.path(open_.back().item);
    if (!is_in_map() || awaits_key()) return path;
    return path + (path.empty() ? "" : ".") + open_.back().key;
  }

  [[noreturn]] void refuse(const YAML::Mark& mark, const std::string& reason) const {
    throw InvalidInput(reason, place(mark));
  }

  void check(const YAML::Mark& mark, YAML::anchor_t anchor, const std::string& tag) const {
    if (anchor != 0) refuse(mark, no_anchors);
    if (!tag.empty() && tag != "?" && tag != "!")
      refuse(mark, "tags (" + in_ticks(tag) + ") are not allowed. Write the value alone");
  }

  void add_key(const YAML::Mark& mark, const std::string& key) {
    if (key.empty()) refuse(mark, "the key is empty. Give a word");
    if (key.size() > max_key_bytes)
      refuse(mark, "the key " + in_ticks(key) + " is too long. Give at most 100 characters");
    if (key.find(':') != std::string::npos)
      refuse(mark, "the key " + in_ticks(key) + " has a `:`. Write a space after the colon, `key: value`");
    Open& map = open_.back();
    map.key = key;
    std::replace_if(
        map.key.begin(), map.key.end(), [](char c) { return c >= 0 && c < ' '; }, '?');
    map.key_position = position(mark);
    map.awaits_key = false;
    const auto [first, is_new] = map.line_of_key.try_emplace(map.key, map.key_position.line);
    if (!is_new)
      refuse(mark, "this key is given twice, first in line " + std::to_string(first->second) +
                       ". Remove one of the two entries");
  }

  int add(const YAML::Mark& mark, Node::Kind kind) {
    const int index = static_cast<int>(tree_.items.size());
    Tree::Item& item = tree_.items.emplace_back();
    item.kind = kind;
    const auto [line, column] = position(mark);
    item.line = line;
    item.column = column;
    if (open_.empty()) return index;
    Open& parent = open_.back();
    auto& siblings = tree_.items[parent.item].children;
    item.parent = parent.item;
    item.position = static_cast<int>(siblings.size());
    siblings.push_back(index);
    if (is_in_map()) name_by_key(item, parent);
    return index;
  }

  static void name_by_key(Tree::Item& item, Open& parent) {
    item.key = parent.key;
    item.key_line = parent.key_position.line;
    item.key_column = parent.key_position.column;
    if (item.kind == Node::Kind::empty) {
      item.line = item.key_line;
      item.column = item.key_column;
    }
    parent.awaits_key = true;
  }

  void open(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, Node::Kind kind) {
    check(mark, anchor, tag);
    if (awaits_key())
      refuse(mark,
             "a list or a map is in the place of a key. Give plain words as keys, and check for a missing "
             "closing bracket");
    if (static_cast<int>(open_.size()) >= max_document_depth)
      refuse(mark, "nested too deep; at most " + std::to_string(max_document_depth) + " levels are allowed");
    const int item = add(mark, kind);
    open_.push_back({item, kind == Node::Kind::map});
  }

  const std::string& text_;
  ColumnCounter columns_{text_};
  Tree& tree_;
  std::vector<Open> open_;
  int documents_ = 0;
};

// Cause for both errors by which yaml-cpp reports a quote that is not closed.
constexpr const char* no_closing_quote = "a closing quote is missing before this place";

bool is_indented_by_tab(const std::string& text, const YAML::Mark& mark) {
  const std::size_t start = start_of_line(text, std::min(static_cast<std::size_t>(mark.pos), text.size()));
  return text.substr(start, text.find_first_not_of(" \t", start) - start).find('\t') != std::string::npos;
}

std::string explain(const std::string& message) {
  // Parts of yaml-cpp's messages, and the causes that users read instead.
  static constexpr std::pair<std::string_view, const char*> causes[] = {
      {"anchor", no_anchors},
      {"alias", no_anchors},
      {"illegal map value",
       "a `:` is not possible here. Check the indentation and the space after each `:`, here and in the line "
       "above"},
      {"end of map not found", "this does not fit the lines above. Check indentation and quotes"},
      {"end of sequence not found", "this does not fit the list above. Check indentation and quotes"},
      {"end of map flow", "a `}` or a comma is missing before this place"},
      {"end of sequence flow", "a `]` or a comma is missing before this place"},
      {"illegal flow end", "a `]` or `}` that closes nothing"},
      {"illegal EOF in scalar", no_closing_quote},
      {"illegal document indicator in scalar", no_closing_quote},
  };
  for (const auto& [sign, cause] : causes)
    if (message.find(sign) != std::string::npos) return cause;
  return "not valid YAML: " + message;
}

}  // namespace

Node parse_document(const std::string& text, const std::string& file) {
  auto tree = std::make_shared<Tree>();
  tree->file = file;
  const std::string lines = text.ends_with('\n') ? text : text + '\n';
  Builder builder(lines, *tree);
  // A document end is an error inside quotes: without it, a quote left open would swallow the rest in
  // silence.
  std::istringstream stream(lines + "...\n");
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) continue;
  } catch (const YAML::Exception& e) {
    const bool has_tab = !e.mark.is_null() && is_indented_by_tab(lines, e.mark);
    throw InvalidInput(has_tab ? "there is a tab in the indentation. Use spaces" : explain(e.msg),
                       builder.place(e.mark));
  }
  if (tree->items.empty() || tree->items[0].kind == Node::Kind::empty)
    throw InvalidInput("holds no values", {file});
  return {std::move(tree), 0};
}

Node read_document(const std::string& file, std::size_t max_bytes) {
  return parse_document(read_text_file(file, max_bytes), file);
}

}  // namespace kinetix::targets
