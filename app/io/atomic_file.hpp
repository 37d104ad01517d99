#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kinetix::app {

/// Writes a whole file or nothing: beside its place under the name `.NAME.kinetix-part-XXXXXX`, flushed to
/// the disk, then renamed. A file that was there before is replaced in one step; on failure it stays and the
/// part is removed.
/// @throws InvalidInput naming the folder or file and the reason
void write_file(const std::string& file, std::string_view content);

/// Takes the next piece of a file.
using FileSink = std::function<void(std::string_view)>;
/// The same for content that comes in pieces. Whatever `produce` throws leaves the file as it was.
void write_file(const std::string& file, const std::function<void(const FileSink&)>& produce);

/// From now on an interrupt, a hangup, a request to terminate or a closed pipe removes the parts that are being
/// written and the folders that were created for them, then ends the program as it would have; a file that grows
/// over the limit of `ulimit -f` is an error as that of a full disk. For programs that write from one thread: the
/// one that calls this.
void remove_parts_when_interrupted();

/// What that handler removes, at any other end of the program. Safe in a signal handler.
extern "C" void remove_unfinished();

/// Removes the same while other threads write: no file of theirs is put into its place after that, and the program must end.
/// For programs that write from several threads, and so handle interrupts themselves.
void remove_unfinished_of_others();

/// Files of one folder that come all together or not at all. What was added and not committed leaves no
/// trace.
class FileSet {
 public:
  explicit FileSet(std::string folder);
  ~FileSet();
  FileSet(const FileSet&) = delete;
  FileSet& operator=(const FileSet&) = delete;

  /// Writes a file under a temporary name, flushed to the disk. @param name path under the folder; folders
  /// that it needs are created. @throws InvalidInput naming the folder or file and the reason
  void add(const std::string& name, std::string_view content);
  /// Renames all, each replacing what was there before. Where one cannot be renamed those before it get their
  /// old content back (on file systems that can exchange two files). @throws InvalidInput likewise
  void commit();

 private:
  struct Files;
  std::unique_ptr<Files> files_;
};

/// A folder for results. It is created with its parents where it does not exist, and proven writable, before
/// any work is done; what was created goes again, if still empty, unless keep() is called. Parts of files that runs
/// left there more than a day ago, when a power cut or SIGKILL ended them, are removed.
class OutputFolder {
 public:
  /// @throws InvalidInput naming the folder and the reason
  explicit OutputFolder(const std::string& path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::string& path() const { return path_; }
  void keep();
  /// What all folders that live have created goes, if empty. Safe in a signal handler.
  static void remove_all_created();

 private:
  void make();
  void remove_created();
  void leave_chain();

  std::string path_;
  std::vector<std::string> created_;  // innermost first
  OutputFolder* older_ = nullptr;
};

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

/// A file of a folder: its path there, and its content.
struct NamedContent {
  std::string name, content;
};

}  // namespace kinetix::app
