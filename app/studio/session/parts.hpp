#pragma once

#include <map>
#include <string>

namespace kinetix::app::studio {

/// Bytes, 32 MiB, of all files that a page sends in parts for a search: a scan of half a million triangles.
inline constexpr int most_part_bytes = 32 << 20;

/// Files that come in parts, since one message holds at most 768 kB.
class Parts {
 public:
  /// @param at bytes of that file that came before: 0 begins it anew
  /// @throws InvalidInput where a part is missing, or the files together would be larger than most_part_bytes
  void add(const std::string& name, int at, const std::string& content);

  const std::map<std::string, std::string>& files() const { return files_; }

 private:
  std::map<std::string, std::string> files_;
};

}  // namespace kinetix::app::studio
