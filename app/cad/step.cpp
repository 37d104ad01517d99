#include "app/cad/step.hpp"

#include "app/cad/step_module.hpp"
#include "model/base/loaded_module.hpp"

namespace kinetix::app::cad {
namespace {

void* cad_function(const char* name) { return model::module_function("kinetix-cad.so", name); }

}  // namespace

void load() { cad_function("kinetix_write_step"); }

std::string step_text(const Product& product) {
  std::string text;
  reinterpret_cast<decltype(&kinetix_write_step)>(cad_function("kinetix_write_step"))(product, text);
  return text;
}

std::vector<FoundSolid> solids_of_step(const std::string& file) {
  std::vector<FoundSolid> solids;
  reinterpret_cast<decltype(&kinetix_read_step)>(cad_function("kinetix_read_step"))(file, solids);
  return solids;
}

}  // namespace kinetix::app::cad
