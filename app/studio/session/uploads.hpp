#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

namespace kinetix::app::studio {

/// Bytes, 32 MiB, of all files that a page sends in parts for a search: a scan of half a million triangles.
inline constexpr std::int64_t max_part_bytes = 32 << 20;
/// Files of a search: a goal needs two or three.
inline constexpr std::size_t max_part_files = 100;

/// Files that are sent in parts, because a message holds at most 768 KiB.
class Parts {
 public:
  /// Appends a part.
  /// @param at number of bytes of the file already sent; 0 starts it anew
  /// @throws InvalidInput if a part is missing, or if the files exceed max_part_bytes or max_part_files.
  /// After exceeding a limit, all parts are refused until one starts a file.
  void add(const std::string& name, std::int64_t at, const std::string& content);

  const std::map<std::string, std::string>& files() const { return files_; }

 private:
  void refuse(const std::string& why);

  std::map<std::string, std::string> files_;
  std::string refusal_;  ///< reason of the last refusal; empty: none
};

/// Makes a folder that is removed with its last owner. @throws InvalidInput if it cannot be made
std::shared_ptr<const std::filesystem::path> make_temporary_folder();
/// Removes all temporary folders that still exist, if the program ends without its owners' destructors.
void remove_temporary_folders();

}  // namespace kinetix::app::studio
