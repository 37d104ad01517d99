#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace kinetix::app {

/// Files that a run writes into a folder, kept there as `sha256sum` lists them. So a later run knows what an earlier one left,
/// and whether somebody has changed it since.
class FileRecord {
 public:
  static constexpr const char* name = ".kinetix-files";  ///< hidden: for the program alone

  /// Reads the record of the earlier run in the folder, if any. @param record its name there
  explicit FileRecord(std::string folder, std::string record = name);

  void add(const std::string& file, std::string_view content);
  /// Keeps what earlier runs wrote for others: it stays, and in the record too.
  void keep(const std::function<bool(const std::string& file)>& is_of_others);
  /// What a file holds that somebody changed since the earlier run wrote it; nothing of other files.
  std::optional<std::string> changed(const std::string& file) const;
  /// Of this run's files: a line `HASH  NAME` each.
  std::string text() const;
  /// Removes what the earlier run wrote and this one does not, and folders that are empty then. Files that
  /// are not as it wrote them stay, as does whatever lies outside the folder or cannot be removed.
  void remove_what_is_left_over() const;

 private:
  using Hashes = std::map<std::string, std::string>;  // by name

  std::string folder_, record_;
  Hashes earlier_, now_;
};

}  // namespace kinetix::app
