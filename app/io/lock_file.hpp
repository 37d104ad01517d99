#pragma once

#include <memory>
#include <string>

namespace kinetix::app {

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

}  // namespace kinetix::app
