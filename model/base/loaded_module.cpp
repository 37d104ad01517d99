#include "model/base/loaded_module.hpp"

#include <dlfcn.h>

#include <stdexcept>

namespace kinetix::model {

void* module_function(const std::string& module, const char* function) {
  // Never closed: what it threw may still be held. A second call finds the one that is loaded.
  void* const loaded = dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (loaded == nullptr)
    throw std::runtime_error(module + ", a part of this program, cannot be loaded: " + dlerror());
  void* const found = dlsym(loaded, function);
  if (found == nullptr) throw std::runtime_error(module + " is of another version: " + dlerror());
  return found;
}

}  // namespace kinetix::model
