#pragma once

#include <string>
#include <string_view>
#include <vector>

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

}  // namespace kinetix::targets
