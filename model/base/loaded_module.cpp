#include "model/base/loaded_module.hpp"

#include <dlfcn.h>
#include <link.h>
#include <unistd.h>

#include <cstddef>
#include <stdexcept>
#include <vector>

namespace kinetix::model {
namespace {

/// Returns the folders in which the loader looks for modules: the run path of the program or library with
/// this code.
std::vector<std::string> module_folders() {
  Dl_info here;
  void* object = nullptr;
  dladdr1(reinterpret_cast<void*>(&module_file), &here, &object, RTLD_DL_LINKMAP);
  Dl_serinfo head;
  if (object == nullptr || dlinfo(object, RTLD_DI_SERINFOSIZE, &head) != 0) return {};
  std::vector<std::max_align_t> room(head.dls_size / sizeof(std::max_align_t) + 1);
  auto* const list = reinterpret_cast<Dl_serinfo*>(room.data());
  *list = head;
  if (dlinfo(object, RTLD_DI_SERINFO, list) != 0) return {};
  std::vector<std::string> folders;
  for (unsigned k = 0; k < head.dls_cnt; ++k) folders.emplace_back(list->dls_serpath[k].dls_name);
  return folders;
}

}  // namespace

std::string module_file(const std::string& name) {
  for (const std::string& folder : module_folders())
    if (const std::string file = folder + "/" + name; access(file.c_str(), X_OK) == 0) return file;
  throw std::runtime_error(name + ", a part of this program, is not among its modules");
}

void* module_function(const std::string& module, const char* function) {
  // Never closed: exceptions that the module threw may still exist. A second call finds the loaded module.
  void* const loaded = dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (loaded == nullptr)
    throw std::runtime_error(module + ", a part of this program, cannot be loaded: " + dlerror());
  void* const found = dlsym(loaded, function);
  if (found == nullptr) throw std::runtime_error(module + " is of another version: " + dlerror());
  return found;
}

}  // namespace kinetix::model
