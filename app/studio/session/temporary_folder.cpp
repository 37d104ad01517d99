#include "app/studio/session/temporary_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <set>

#include "model/base/invalid_input.hpp"

namespace kinetix::app::studio {
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
