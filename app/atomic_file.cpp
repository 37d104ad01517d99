#include "app/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>
#include <utility>

#include "model/invalid_input.hpp"

namespace kinetix {
namespace {

namespace fs = std::filesystem;

std::string folder_of(const fs::path& file) {
  const std::string parent = file.parent_path().string();
  return parent.empty() ? "." : parent;
}

constexpr int interrupts[] = {SIGINT, SIGTERM, SIGHUP};

/// The part being written, for the signal handler alone.
char unfinished_part[PATH_MAX] = "";

/// The thread that writes files, and that alone holds signals back.
pthread_t writer;

extern "C" void remove_part_and_end(int signal_number) {
  if (!pthread_equal(pthread_self(), writer)) {
    pthread_kill(writer, signal_number);
    return;
  }
  if (unfinished_part[0] != 0) unlink(unfinished_part);
  std::signal(signal_number, SIG_DFL);
  std::raise(signal_number);
}

void remember_part(const std::string& path) {
  unfinished_part[0] = 0;
  if (path.size() >= sizeof unfinished_part) return;
  // Last of all the first byte, so that the handler never sees half a name.
  std::copy(path.begin() + (path.empty() ? 0 : 1), path.end(), unfinished_part + 1);
  unfinished_part[path.size()] = 0;
  std::atomic_signal_fence(std::memory_order_seq_cst);
  if (!path.empty()) unfinished_part[0] = path[0];
}

/// Holds the signals back while it lives: no part may exist that the handler does not know.
class NoInterrupts {
 public:
  NoInterrupts() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal_number : interrupts) sigaddset(&signals, signal_number);
    pthread_sigmask(SIG_BLOCK, &signals, &before_);
  }
  ~NoInterrupts() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  NoInterrupts(const NoInterrupts&) = delete;
  NoInterrupts& operator=(const NoInterrupts&) = delete;

 private:
  sigset_t before_;
};

/// A file under a temporary name, removed again unless it was renamed.
class Part {
 public:
  explicit Part(fs::path file) : file_(std::move(file)) {
    const NoInterrupts until_remembered;
    for (int attempt = 0; attempt < 100 && descriptor_ < 0; ++attempt) {
      path_ = file_.parent_path() /
              fmt::format(".{}.kinetix-part-{:06x}", file_.filename().string(), random_() & 0xffffff);
      descriptor_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor_ < 0 && errno != EEXIST) break;
    }
    if (descriptor_ < 0)
      throw InvalidInput(fmt::format("cannot write into this folder: {}", std::strerror(errno)),
                         {folder_of(file_)});
    remember_part(path_);
  }

  ~Part() {
    if (descriptor_ >= 0) close(descriptor_);
    if (!path_.empty()) unlink(path_.c_str());
    remember_part("");
  }

  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  void write(std::string_view content) {
    while (!content.empty()) {
      const ssize_t written = ::write(descriptor_, content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail();
      content.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  void commit() {
    if (fsync(descriptor_) != 0 && errno != EINVAL) fail();
    if (close(std::exchange(descriptor_, -1)) != 0) fail();
    if (std::rename(path_.c_str(), file_.c_str()) != 0) fail();
    path_.clear();
    remember_part("");
    flush_folder();
  }

 private:
  [[noreturn]] void fail() const {
    throw InvalidInput(fmt::format("cannot be written: {}", std::strerror(errno)), {file_.string()});
  }

  /// So that the new name survives a power cut; some file systems cannot, and the file is whole either way.
  void flush_folder() const {
    const int folder = open(folder_of(file_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return;
    fsync(folder);
    close(folder);
  }

  fs::path file_, path_;
  int descriptor_ = -1;
  std::random_device random_;
};

}  // namespace

void remove_parts_when_interrupted() {
  writer = pthread_self();
  for (const int signal_number : interrupts) std::signal(signal_number, remove_part_and_end);
}

void write_file(const std::string& file, std::string_view content) {
  write_file(file, [&](const FileSink& sink) { sink(content); });
}

void write_file(const std::string& file, const std::function<void(const FileSink&)>& produce) {
  Part part{fs::path(file)};
  produce([&](std::string_view piece) { part.write(piece); });
  part.commit();
}

OutputFolder::OutputFolder(const std::string& path) : path_(path) {
  if (path.empty()) throw InvalidInput("the output folder has no name");
  for (fs::path p = fs::absolute(path);
       !p.empty() && !fs::exists(fs::symlink_status(p)) && p != p.parent_path(); p = p.parent_path())
    if (p.has_filename()) created_.push_back(p);
  std::error_code error, ignored;
  fs::create_directories(path, error);
  if (!fs::is_directory(path, ignored)) {
    remove_created();
    const std::string reason = error ? error.message() : "something else has this name";
    throw InvalidInput("cannot create this output folder: " + reason, {path});
  }
  try {
    Part{fs::path(path) / "probe"};
  } catch (const InvalidInput&) {
    remove_created();
    throw;
  }
}

OutputFolder::~OutputFolder() { remove_created(); }

void OutputFolder::remove_created() {
  for (const std::string& folder : created_) rmdir(folder.c_str());
  created_.clear();
}

}  // namespace kinetix
