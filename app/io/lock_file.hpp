#pragma once

#include <memory>
#include <string>

namespace kinetix::app {

/// A file that one program at a time holds. It is removed with the lock, at interrupts too. A file that SIGKILL or
/// a power cut left locks nobody out.
class LockFile {
 public:
  /// @return null where another program holds it, or it cannot be made
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
