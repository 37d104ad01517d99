#include "targets/document/tree.hpp"

#include <algorithm>

namespace kinetix::targets {

std::string Tree::path(int item) const {
  std::vector<int> chain;
  for (; items[item].parent >= 0; item = items[item].parent) chain.push_back(item);
  std::reverse(chain.begin(), chain.end());
  std::string text;
  for (const int link : chain) {
    const Item& at = items[link];
    if (items[at.parent].kind == Node::Kind::list)
      text += "[" + std::to_string(at.position) + "]";
    else
      text += (text.empty() ? "" : ".") + at.key;
  }
  return text;
}

}  // namespace kinetix::targets
