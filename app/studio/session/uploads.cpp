#include "app/studio/session/uploads.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <set>

#include "model/base/invalid_input.hpp"

namespace kinetix::app::studio {

/// Drops all files and refuses further parts.
void Parts::refuse(const std::string& why) {
  files_.clear();
  refusal_ = why;
  throw InvalidInput(why);
}

void Parts::add(const std::string& name, std::int64_t at, const std::string& content) {
  if (at == 0) {
    files_.erase(name);
    refusal_.clear();
  }
  if (!refusal_.empty()) throw InvalidInput(refusal_);
  const auto here = files_.find(name);
  const auto came = static_cast<std::int64_t>(here == files_.end() ? 0 : here->second.size());
  if (at != came)
    throw InvalidInput(
        fmt::format("at: {} of the {} bytes of {} arrived. Send the file again from 0", at, came, name));
  auto all = static_cast<std::int64_t>(content.size());
  for (const auto& [other, text] : files_) all += static_cast<std::int64_t>(text.size());
  if (all > max_part_bytes)
    refuse(
        fmt::format("content: files of a search have more than {} MiB in all. Name larger files in a target "
                    "file, and start the studio with it",
                    max_part_bytes >> 20));
  if (here == files_.end() && files_.size() >= max_part_files)
    refuse(fmt::format("name: a search has at most {} files. Send only those that its target names",
                       max_part_files));
  files_[name] += content;
}

namespace {

namespace fs = std::filesystem;

std::mutex folders_mutex;
std::set<fs::path> temporary_folders;

void remove_temporary(const fs::path* path) {
  std::error_code ignored;
  fs::remove_all(*path, ignored);
  const std::lock_guard lock(folders_mutex);
  temporary_folders.erase(*path);
  delete path;
}

}  // namespace

std::shared_ptr<const fs::path> make_temporary_folder() {
  const char* given = std::getenv("TMPDIR");
  const fs::path place = given && *given ? given : "/tmp";
  std::string name = (place / "kinetix-studio-XXXXXX").string();
  if (!mkdtemp(name.data()))
    throw InvalidInput(fmt::format("no temporary folder can be made here: {}. Make this folder, or start the "
                                   "studio with TMPDIR set to one that is there.",
                                   std::strerror(errno)),
                       {place.string()});
  std::shared_ptr<const fs::path> folder(new fs::path(name), remove_temporary);
  const std::lock_guard lock(folders_mutex);
  temporary_folders.insert(*folder);
  return folder;
}

void remove_temporary_folders() {
  const std::lock_guard lock(folders_mutex);
  std::error_code ignored;
  for (const fs::path& folder : temporary_folders) fs::remove_all(folder, ignored);
}

}  // namespace kinetix::app::studio
