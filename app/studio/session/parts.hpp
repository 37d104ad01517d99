#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace kinetix::app::studio {

/// Bytes, 32 MiB, of all files that a page sends in parts for a search: a scan of half a million triangles.
inline constexpr std::int64_t most_part_bytes = 32 << 20;
/// Files of a search: a goal takes two or three.
inline constexpr std::size_t most_part_files = 100;

/// Files that come in parts, since one message holds at most 768 kB.
class Parts {
 public:
  /// @param at bytes of that file that came before: 0 begins it anew
  /// @throws InvalidInput where a part is missing, or the files together would be larger than most_part_bytes or more than
  /// most_part_files; then for all parts up to the next that begins a file
  void add(const std::string& name, std::int64_t at, const std::string& content);

  const std::map<std::string, std::string>& files() const { return files_; }

 private:
  void refuse(const std::string& why);

  std::map<std::string, std::string> files_;
  std::string refusal_;  ///< of the parts before; empty: they were taken
};

}  // namespace kinetix::app::studio
