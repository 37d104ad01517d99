#include "app/io/lock_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <mutex>
#include <utility>

#include "app/io/held_signals.hpp"

namespace kinetix::app {
namespace {

LockFile* newest_lock = nullptr;  // a chain, for the signal handler
std::mutex lock_chain;            // guards it; the signal handler does not lock it

/// Checks whether a name still leads to the opened file: its holder may have removed it before it was locked here.
bool is_named(int descriptor, const std::string& file) {
  struct stat opened, named;
  return fstat(descriptor, &opened) == 0 && stat(file.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

}  // namespace

std::unique_ptr<LockFile> LockFile::acquire(const std::string& file) {
  const HeldSignals until_chained;
  while (true) {
    const int descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (descriptor < 0) return nullptr;
    const bool is_held = flock(descriptor, LOCK_EX | LOCK_NB) != 0;
    if (!is_held && is_named(descriptor, file))
      return std::unique_ptr<LockFile>(new LockFile(file, descriptor));
    close(descriptor);
    if (is_held) return nullptr;
  }
}

LockFile::LockFile(std::string file, int descriptor) : file_(std::move(file)), descriptor_(descriptor) {
  const std::lock_guard lock(lock_chain);
  older_ = std::exchange(newest_lock, this);
}

LockFile::~LockFile() {
  const HeldSignals until_unchained;
  const std::lock_guard lock(lock_chain);
  unlink(file_.c_str());
  close(descriptor_);
  LockFile** link = &newest_lock;
  while (*link != this) link = &(*link)->older_;
  *link = older_;
}

void LockFile::remove_all() {
  for (const LockFile* lock = newest_lock; lock != nullptr; lock = lock->older_) unlink(lock->file_.c_str());
}

}  // namespace kinetix::app
