#include "app/cad/step.hpp"

#include <filesystem>

#include "app/cad/solid_bytes.hpp"
#include "app/cad/step_module.hpp"
#include "app/io/reader_program.hpp"
#include "model/base/invalid_input.hpp"
#include "model/base/loaded_module.hpp"

namespace kinetix::app::cad {
namespace {

// CPU time limit in s. Files of this program take 1 s per MiB. Damaged files that crash the reader do so at once.
constexpr unsigned long least_s = 20, s_per_mebibyte = 10;
constexpr unsigned long most_bytes = 4ul << 30;  // bytes: 4 GiB of address space, libraries included

void* cad_function(const char* name) { return model::module_function("kinetix-cad.so", name); }

}  // namespace

void load() { cad_function("kinetix_write_step"); }

std::string step_text(const Product& product) {
  std::string text;
  reinterpret_cast<decltype(&kinetix_write_step)>(cad_function("kinetix_write_step"))(product, text);
  return text;
}

std::vector<FoundSolid> solids_of_step(const std::string& file) {
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(file, unknown);
  const unsigned long mebibytes = unknown ? 0 : static_cast<unsigned long>(size >> 20);
  const std::string bytes =
      run_reader("kinetix-read-step", {file}, {least_s + s_per_mebibyte * mebibytes, most_bytes});
  try {
    return read_solids(bytes);
  } catch (const std::runtime_error& e) {
    throw InvalidInput(std::string("is damaged: ") + e.what());
  }
}

}  // namespace kinetix::app::cad
