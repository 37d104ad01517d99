#pragma once

#include <string>
#include <vector>

#include "targets/document/keys.hpp"

namespace kinetix::app {

/// A map whose keys the page of formats lists together: a whole file, or a section that several files share.
struct KeyList {
  std::string name;  ///< "target curve", "design", "doe", "Section physics"
  const targets::KeyTable* keys;
};

/// Every key of every file that the program reads, in the order of the documentation. The readers read by
/// the same tables.
std::vector<KeyList> all_keys();

}  // namespace kinetix::app
