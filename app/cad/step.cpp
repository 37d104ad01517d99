#include "app/cad/step.hpp"

#include <dlfcn.h>

#include <stdexcept>

#include "app/cad/step_module.hpp"

namespace kinetix::app::cad {
namespace {

void* module_function(const char* name) {
  // Never closed: what it threw may still be held. Where it is looked for, the program's own run path says.
  static void* const module = dlopen("kinetix-cad.so", RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr)
    throw std::runtime_error(
        std::string("STEP is read and written by a part of the program that cannot be loaded: ") + dlerror());
  void* const function = dlsym(module, name);
  if (function == nullptr)
    throw std::runtime_error(std::string("kinetix-cad.so is of another version: ") + dlerror());
  return function;
}

}  // namespace

std::string step_text(const Product& product) {
  std::string text;
  reinterpret_cast<decltype(&kinetix_write_step)>(module_function("kinetix_write_step"))(product, text);
  return text;
}

std::vector<FoundSolid> solids_of_step(const std::string& file) {
  std::vector<FoundSolid> solids;
  reinterpret_cast<decltype(&kinetix_read_step)>(module_function("kinetix_read_step"))(file, solids);
  return solids;
}

}  // namespace kinetix::app::cad
