#include "app/io/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <random>
#include <utility>

#include "app/io/bytes.hpp"
#include "model/base/invalid_input.hpp"

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

namespace {

namespace fs = std::filesystem;

std::string folder_of(const fs::path& file) {
  const std::string parent = file.parent_path().string();
  return parent.empty() ? "." : parent;
}

constexpr const char* part_mark = ".kinetix-part-";  // in the names of parts, after the file's name
constexpr std::chrono::hours old_part{24};           // far more than any run takes to write its files

class Part;

/// Chains of the existing parts and of the new folders, for the signal handler.
Part* newest_part = nullptr;
OutputFolder* newest_folder = nullptr;

/// Guards the chains, and files that are put in place together. The signal handler does not lock it: a program that
/// writes from several threads handles signals in another way.
std::mutex chains;

/// The thread that handles signals.
pthread_t writer;

/// File under a temporary name. The destructor removes what has that name in the end: the part itself, or the file
/// that it replaced.
class Part {
 public:
  explicit Part(fs::path file) : file_(std::move(file)) {
    const HeldSignals until_chained;
    for (int attempt = 0; attempt < 100 && descriptor_ < 0; ++attempt) {
      path_ = file_.parent_path() /
              fmt::format(".{}{}{:06x}", file_.filename().string(), part_mark, random_() & 0xffffff);
      descriptor_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor_ < 0 && errno != EEXIST) break;
    }
    if (descriptor_ < 0)
      throw InvalidInput(fmt::format("cannot write into this folder: {}", std::strerror(errno)),
                         {folder_of(file_)});
    const std::lock_guard lock(chains);
    older_ = std::exchange(newest_part, this);
  }

  ~Part() {
    const HeldSignals until_unchained;
    const std::lock_guard lock(chains);
    if (descriptor_ >= 0) close(descriptor_);
    remove();
    Part** link = &newest_part;
    while (*link != this) link = &(*link)->older_;
    *link = older_;
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

  /// Flushes and closes the part. From here on it is whole on the disk.
  void finish() {
    if (fsync(descriptor_) != 0 && errno != EINVAL) fail();
    if (close(std::exchange(descriptor_, -1)) != 0) fail();
  }

  /// Gives the part its name. An old file gets the name of the part, so that it can be put back. @pre finished,
  /// interrupts held back
  void put_in_place() {
    std::error_code unknown;
    const fs::file_status old = fs::symlink_status(file_, unknown);
    if (fs::is_directory(old)) fail(EISDIR);
    is_new_ = !fs::exists(old);
    if (!is_new_ && exchange()) return;
    if (std::rename(path_.c_str(), file_.c_str()) != 0) fail();
    path_.clear();
  }

  /// Undoes put_in_place(). The new file stays if the old one was not kept.
  void put_back() {
    if (is_new_)
      unlink(file_.c_str());
    else if (!path_.empty())
      exchange();
  }

  /// Flushes the folder so that the new name survives a power cut. Some file systems cannot; the file is whole anyway.
  void flush_folder() const {
    const int folder = open(folder_of(file_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return;
    fsync(folder);
    close(folder);
  }

  /// Removes the temporary name. Safe in a signal handler.
  void remove() const {
    if (!path_.empty()) unlink(path_.c_str());
  }
  const Part* older() const { return older_; }

 private:
  bool exchange() const {
    return renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, file_.c_str(), RENAME_EXCHANGE) == 0;
  }

  [[noreturn]] void fail(int error = errno) const {
    throw InvalidInput(fmt::format("cannot be written: {}", std::strerror(error)), {file_.string()});
  }

  fs::path file_, path_;
  int descriptor_ = -1;
  bool is_new_ = false;
  Part* older_ = nullptr;
  std::random_device random_;
};

extern "C" void remove_parts_and_end(int signal_number) {
  if (!pthread_equal(pthread_self(), writer)) {
    pthread_kill(writer, signal_number);
    return;
  }
  remove_unfinished();
  std::signal(signal_number, SIG_DFL);
  std::raise(signal_number);
}

/// Removes old parts of runs that a power cut or SIGKILL ended. Parts that cannot be removed stay.
void remove_old_parts(const fs::path& folder) {
  std::error_code unknown;
  const auto now = fs::file_time_type::clock::now();
  for (fs::directory_iterator file(folder, unknown), end; !unknown && file != end; file.increment(unknown)) {
    const std::string name = file->path().filename().string();
    if (!name.starts_with(".") || name.find(part_mark) == std::string::npos) continue;
    std::error_code gone;
    if (now - fs::last_write_time(file->path(), gone) > old_part && !gone) fs::remove(file->path(), gone);
  }
}

void put_all_in_place(std::deque<Part>& parts) {
  const HeldSignals until_all_are_there;
  const std::lock_guard lock(chains);
  std::size_t count = 0;
  try {
    for (; count < parts.size(); ++count) parts[count].put_in_place();
  } catch (...) {
    while (count > 0) parts[--count].put_back();
    throw;
  }
}

constexpr std::size_t hash_digits = 64;               // of SHA-256 in hexadecimal
constexpr std::size_t name_column = hash_digits + 2;  // characters: `sha256sum` puts two spaces between

std::map<std::string, std::string> read_record(const fs::path& file) {
  std::map<std::string, std::string> hashes;
  std::error_code missing;
  if (!fs::is_regular_file(file, missing)) return hashes;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.size() > name_column) hashes[line.substr(name_column)] = line.substr(0, hash_digits);
  return hashes;
}

/// Checks whether a name is a regular file of the folder itself: no link, and no path that leads outside.
bool is_inside(const fs::path& folder, const fs::path& name) {
  if (name.is_absolute()) return false;
  std::error_code missing;
  const fs::path real = fs::canonical(folder / name, missing);
  return !missing && real == fs::canonical(folder, missing) / name && fs::is_regular_file(real, missing);
}

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void remove_with_empty_folder(const fs::path& folder, const fs::path& name) {
  std::error_code stays;
  fs::remove(folder / name, stays);
  if (name.has_parent_path()) fs::remove((folder / name).parent_path(), stays);
}

}  // namespace

extern "C" void remove_unfinished() {
  for (const Part* part = newest_part; part != nullptr; part = part->older()) part->remove();
  OutputFolder::remove_all_created();
  LockFile::remove_all();
}

void remove_unfinished_of_others() {
  chains.lock();
  remove_unfinished();
}

void remove_parts_when_interrupted() {
  writer = pthread_self();
  for (const int signal_number : interrupts) std::signal(signal_number, remove_parts_and_end);
  std::signal(SIGXFSZ, SIG_IGN);  // so that writing too large a file fails with a reason
}

void write_file(const std::string& file, std::string_view content) {
  write_file(file, [&](const FileSink& sink) { sink(content); });
}

void write_file(const std::string& file, const std::function<void(const FileSink&)>& produce) {
  Part part{fs::path(file)};
  produce([&](std::string_view piece) { part.write(piece); });
  part.finish();
  const HeldSignals until_it_is_there;
  const std::lock_guard lock(chains);
  part.put_in_place();
  part.flush_folder();
}

struct FileSet::Files {
  fs::path folder;
  std::map<fs::path, OutputFolder> folders;  // created here; outlive the parts in them
  std::deque<Part> parts;
};

FileSet::FileSet(std::string folder) : files_(new Files{std::move(folder), {}, {}}) {}

FileSet::~FileSet() = default;

void FileSet::add(const std::string& name, std::string_view content) {
  const fs::path file = files_->folder / name, parent = file.parent_path();
  files_->folders.try_emplace(parent, parent.string());
  Part& part = files_->parts.emplace_back(file);
  part.write(content);
  part.finish();
}

void FileSet::commit() {
  put_all_in_place(files_->parts);
  for (auto& [path, folder] : files_->folders) folder.keep();
  for (const Part& part : files_->parts) part.flush_folder();
  files_->parts.clear();
}

OutputFolder::OutputFolder(const std::string& path) : path_(path) {
  if (path.empty()) throw InvalidInput("the output folder has no name");
  std::error_code error, unknown;  // set for names that no folder can have: make() reports them
  fs::path p = fs::absolute(path, error);
  if (error) throw InvalidInput("cannot create this output folder: " + error.message(), {path});
  for (; !p.empty() && !fs::exists(fs::symlink_status(p, unknown)) && p != p.parent_path();
       p = p.parent_path())
    if (p.has_filename()) created_.push_back(p);
  {
    const HeldSignals until_chained;
    const std::lock_guard lock(chains);
    older_ = std::exchange(newest_folder, this);
  }
  try {
    make();
  } catch (...) {
    remove_created();
    throw;
  }
}

OutputFolder::~OutputFolder() { remove_created(); }

void OutputFolder::make() {
  std::error_code error, ignored;
  fs::create_directories(path_, error);
  if (!fs::is_directory(path_, ignored)) {
    const std::string reason = error ? error.message() : "something else has this name";
    throw InvalidInput("cannot create this output folder: " + reason, {path_});
  }
  Part{fs::path(path_) / "probe"};
  remove_old_parts(path_);
}

void OutputFolder::keep() {
  const HeldSignals until_kept;
  const std::lock_guard lock(chains);
  leave_chain();
}

void OutputFolder::remove_created() {
  const HeldSignals until_removed;
  const std::lock_guard lock(chains);
  for (const std::string& folder : created_) rmdir(folder.c_str());
  leave_chain();
}

void OutputFolder::leave_chain() {
  created_.clear();
  for (OutputFolder** link = &newest_folder; *link != nullptr; link = &(*link)->older_)
    if (*link == this) {
      *link = older_;
      return;
    }
}

void OutputFolder::remove_all_created() {
  for (const OutputFolder* folder = newest_folder; folder != nullptr; folder = folder->older_)
    for (const std::string& path : folder->created_) rmdir(path.c_str());
}

FileRecord::FileRecord(std::string folder, std::string record)
    : folder_(std::move(folder)),
      record_(std::move(record)),
      earlier_(read_record(fs::path(folder_) / record_)) {}

void FileRecord::add(const std::string& file, std::string_view content) { now_[file] = sha256(content); }

void FileRecord::keep(const std::function<bool(const std::string& file)>& is_foreign) {
  for (const auto& [file, hash] : earlier_)
    if (is_foreign(file)) now_.emplace(file, hash);
}

std::optional<std::string> FileRecord::changed(const std::string& file) const {
  const auto earlier = earlier_.find(file);
  if (earlier == earlier_.end() || !is_inside(folder_, file)) return std::nullopt;
  std::string content = content_of(fs::path(folder_) / file);
  return sha256(content) == earlier->second ? std::nullopt : std::optional(std::move(content));
}

std::string FileRecord::text() const {
  std::string text;
  for (const auto& [file, hash] : now_) text += hash + "  " + file + "\n";
  return text;
}

void FileRecord::remove_leftovers() const {
  for (const auto& [file, hash] : earlier_)
    if (!now_.contains(file) && is_inside(folder_, file) &&
        sha256(content_of(fs::path(folder_) / file)) == hash)
      remove_with_empty_folder(folder_, file);
  if (now_.empty() && !earlier_.empty()) remove_with_empty_folder(folder_, record_);
}

}  // namespace kinetix::app
