#pragma once

#include <csignal>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kinetix::app {

inline constexpr int interrupts[] = {SIGINT, SIGTERM, SIGHUP,
                                     SIGPIPE};  ///< signals that ask a program to end

/// Guard that holds interrupts back while it lives: no file may exist that the signal handler does not know.
class HeldSignals {
 public:
  HeldSignals() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal_number : interrupts) sigaddset(&signals, signal_number);
    pthread_sigmask(SIG_BLOCK, &signals, &before_);
  }
  ~HeldSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

 private:
  sigset_t before_;
};

/// File that one program at a time holds. It is removed with the lock, also at interrupts. A file that SIGKILL or a
/// power cut left does not lock anybody out.
class LockFile {
 public:
  /// @return null if another program holds it, or if it cannot be made
  static std::unique_ptr<LockFile> acquire(const std::string& file);
  ~LockFile();
  LockFile(const LockFile&) = delete;
  LockFile& operator=(const LockFile&) = delete;

  /// Removes the files of all locks that live. Safe in a signal handler.
  static void remove_all();

 private:
  LockFile(std::string file, int descriptor);

  std::string file_;
  int descriptor_;
  LockFile* older_ = nullptr;
};

/// Writes a whole file or nothing. The content goes to `.NAME.kinetix-part-XXXXXX` in the same folder, is flushed to
/// the disk and then renamed. An existing file is replaced in one step. On failure it stays and the part is removed.
/// @throws InvalidInput naming the folder or file and the reason
void write_file(const std::string& file, std::string_view content);

/// Function that takes the next piece of a file.
using FileSink = std::function<void(std::string_view)>;
/// Writes a whole file or nothing, from pieces that `produce` passes on. If `produce` throws, an existing file stays.
void write_file(const std::string& file, const std::function<void(const FileSink&)>& produce);

/// Handles interrupts, hangups, requests to terminate and closed pipes from now on. The handler removes the parts that
/// are being written and the folders created for them, then ends the program as the signal does. A file above the
/// limit of `ulimit -f` becomes an error, like a full disk. This is for programs that write only from the thread that
/// calls it.
void remove_parts_when_interrupted();

/// Removes unfinished files, new empty folders and lock files, for other ends of the program. Safe in a signal
/// handler.
extern "C" void remove_unfinished();

/// Removes unfinished files while other threads write. Afterwards they put no file in place, and the program must end.
/// It is for programs that write from several threads and handle interrupts themselves.
void remove_unfinished_of_others();

/// Files of one folder that are put in place all together or not at all. Files that were not committed leave no trace.
class FileSet {
 public:
  explicit FileSet(std::string folder);
  ~FileSet();
  FileSet(const FileSet&) = delete;
  FileSet& operator=(const FileSet&) = delete;

  /// Writes a file under a temporary name, flushed to the disk. @param name path under the folder; folders
  /// that it needs are created. @throws InvalidInput naming the folder or file and the reason
  void add(const std::string& name, std::string_view content);
  /// Renames all files, each replacing an existing one. If one cannot be renamed, those before it get their old
  /// content back (on file systems that can exchange two files). @throws InvalidInput naming the file and the reason
  void commit();

 private:
  struct Files;
  std::unique_ptr<Files> files_;
};

/// Folder for results. It is created with its parents if missing, and proven writable, before any work is done.
/// Created folders are removed if still empty, unless keep() is called. Parts of files that are older than a day are
/// removed: runs left them when a power cut or SIGKILL ended them.
class OutputFolder {
 public:
  /// @throws InvalidInput naming the folder and the reason
  explicit OutputFolder(const std::string& path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::string& path() const { return path_; }
  void keep();
  /// Removes the empty folders that all living objects have created. Safe in a signal handler.
  static void remove_all_created();

 private:
  void make();
  void remove_created();
  void leave_chain();

  std::string path_;
  std::vector<std::string> created_;  // innermost first
  OutputFolder* older_ = nullptr;
};

/// Record of the files that a run writes into a folder, kept there in the form of `sha256sum`. It shows a later run
/// what an earlier one left, and whether anybody has changed it since.
class FileRecord {
 public:
  static constexpr const char* name = ".kinetix-files";  ///< hidden: for the program only

  /// Reads the record of the earlier run in the folder, if any. @param record its name there
  explicit FileRecord(std::string folder, std::string record = name);

  void add(const std::string& file, std::string_view content);
  /// Keeps files that earlier runs wrote for others, and their lines in the record.
  void keep(const std::function<bool(const std::string& file)>& is_foreign);
  /// Returns the content of a file that was changed since the earlier run wrote it. Empty for other files.
  std::optional<std::string> changed(const std::string& file) const;
  /// Returns the record of this run's files: a line `HASH  NAME` for each.
  std::string text() const;
  /// Removes files that the earlier run wrote and this one does not, and folders that become empty. Files that were
  /// changed stay, and files outside the folder or that cannot be removed.
  void remove_leftovers() const;

 private:
  using Hashes = std::map<std::string, std::string>;  // by name

  std::string folder_, record_;
  Hashes earlier_, now_;
};

/// File of a folder: its path in the folder, and its content.
struct NamedContent {
  std::string name, content;
};

}  // namespace kinetix::app
