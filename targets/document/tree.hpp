#pragma once

#include <string>
#include <vector>

#include "targets/document/document.hpp"

namespace kinetix::targets {

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
